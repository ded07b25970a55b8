from tests.harness.conftest import fmu, instance

__all__ = ["fmu", "instance"]
