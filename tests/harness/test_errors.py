from slider_resonator.errors import unknown_name


def test_the_nearest_name_is_suggested_whatever_its_case() -> None:
    text = unknown_name("input", "Phse", ["phase", "load"])
    assert text == "unknown input 'Phse'; did you mean 'phase'? (must be one of load, phase)"
    assert "did you mean" not in unknown_name("input", "xyzzy", ["phase", "load"])
    scenes = [f"scene_{number}" for number in range(200)] + ["steady_contact"]
    text = unknown_name("scene", "steady_velocity", scenes)
    assert text.startswith("unknown scene 'steady_velocity'; did you mean 'steady_contact'?")
    assert "(must be one of 201, such as steady_contact, scene_" in text
    assert len(text) < 250


def test_the_only_name_with_that_part_comes_before_one_that_looks_like_it() -> None:
    text = unknown_name("parameter or input", "preload", ["load", "normal_preload", "phase"])
    assert "did you mean 'normal_preload'?" in text


def test_a_symbol_stands_for_its_parameter() -> None:
    text = unknown_name("parameter", "mu", ["slider_mass", "friction_coefficient"])
    assert "'mu'; did you mean 'friction_coefficient'?" in text
    assert "did you mean" not in unknown_name("output", "mu", ["position"])
