/** Seconds on the screen for a drive period. */
const SHOWN_PERIOD = 1.6;
/** Largest excursions on the screen, and the lengths of arrows, in units of the drawing. */
const SLIDER_REACH = 24;
const RESONATOR_REACH = 42;
const ARROW = 62;

/** The sketch moves as in a record of some periods, slowed down; fast motion is enlarged. */
class Sketch {
  constructor() {
    this.paused = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.clock = 0;
    const button = document.getElementById("pause");
    const showState = () => {
      button.textContent = this.paused ? "Move" : "Pause";
      button.setAttribute("aria-pressed", String(this.paused));
    };
    button.addEventListener("click", () => {
      this.paused = !this.paused;
      showState();
      this.#nextFrame();
    });
    showState();
  }

  show({ closeUp, period, load, faces }) {
    const count = closeUp.time.length;
    const mean = (closeUp.position[count - 1] - closeUp.position[0]) / (count - 1);
    // The position without its mean motion is the fast vibration.
    const fast = closeUp.position.map((x, i) => x - mean * i);
    const middle = (Math.min(...fast) + Math.max(...fast)) / 2;
    const largest = (values) => Math.max(...values.map(Math.abs)) || 1;
    const vibration = fast.map((x) => x - middle);
    const reach = largest(vibration);
    this.frames = {
      slider: scaled(vibration, SLIDER_REACH / reach),
      travel: (mean * SLIDER_REACH) / reach,
      resonator: scaled(closeUp.resonator_displacement,
        RESONATOR_REACH / largest(closeUp.resonator_displacement)),
      normal: scaled(closeUp.normal_force, ARROW / largest(closeUp.normal_force)),
      friction: scaled(closeUp.friction_force,
        ARROW / largest([...closeUp.friction_force, load])),
      load: (ARROW * load) / largest([...closeUp.friction_force, load]),
      modes: closeUp.contact_mode,
    };
    const slowed = SHOWN_PERIOD / period;
    const factor = slowed < 1e5 ? String(Number(slowed.toPrecision(2))) : slowed.toExponential(1).replace("e+", "e");
    const text = `${factor} times slower`;
    document.getElementById("slowed").textContent = text;
    document.querySelectorAll(".second-face").forEach((part) => {
      part.setAttribute("visibility", faces === 2 ? "visible" : "hidden");
    });
    this.#draw();
    this.#nextFrame();
  }

  #nextFrame() {
    if (this.paused || this.waiting || !this.frames) {
      return;
    }
    this.waiting = true;
    requestAnimationFrame((now) => {
      this.waiting = false;
      this.clock += Math.min(0.1, (now - (this.last ?? now)) / 1e3);
      this.last = now;
      this.#draw();
      this.#nextFrame();
    });
  }

  #draw() {
    const { slider, travel, resonator, normal, friction, load, modes } = this.frames;
    const samples = (this.clock / SHOWN_PERIOD) * SAMPLES_PER_PERIOD;
    const i = Math.floor(samples) % (slider.length - 1);
    const put = (id, attributes) => {
      const element = document.getElementById(id);
      Object.entries(attributes).forEach(([name, value]) => element.setAttribute(name, value));
    };
    put("slider", { transform: `translate(${slider[i].toFixed(2)} 0)` });
    put("ground", { transform: `translate(${(-(travel * samples) % 40).toFixed(2)} 0)` });
    put("rail", { transform: `translate(${(-(travel * samples) % 40).toFixed(2)} 0)` });
    const left = 300 + resonator[i];
    put("resonator", { x: left });
    put("resonator-label", { x: left + 35 });
    const coil = (left - 190) / 10;
    const turns = Array.from({ length: 8 }, (_, k) => `L ${190 + coil * (k + 1.5)} ${k % 2 ? 137 : 113}`);
    put("spring", { d: `M 190 125 L ${190 + coil} 125 ${turns.join(" ")} L ${left} 125` });
    const mark = `var(--${MODES.get(modes[i]).colour})`;
    put("contact", { style: `stroke: ${mark}` });
    put("second-contact", { style: `stroke: ${mark}` });
    arrow("normal", 320, 62 - normal[i], 320, 62, normal[i]);
    arrow("friction", 320, 172, 320 - friction[i], 172, friction[i]);
    arrow("load-arrow", 458 + Math.max(load, 0), 150, 458 + Math.max(-load, 0), 150, load);
  }
}

function arrow(id, x1, y1, x2, y2, length) {
  const element = document.getElementById(id);
  element.setAttribute("d", `M ${x1} ${y1} L ${x2} ${y2}`);
  element.setAttribute("visibility", Math.abs(length) < 2 ? "hidden" : "visible");
}
