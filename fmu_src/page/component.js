"use strict";

/** Value by variable; `reference` is the value reference, `factor` that of the display unit. */
const VARIABLES = JSON.parse(document.getElementById("variables").textContent);
const BY_NAME = new Map(VARIABLES.map((variable) => [variable.name, variable]));
const OUTPUTS = VARIABLES.filter((variable) => variable.causality === "output");
const SETTABLE = VARIABLES.filter((variable) => variable.causality !== "output");
const PARAMETERS = VARIABLES.filter((variable) => variable.causality === "parameter");

/** What the component refuses: its text names the variable, its value and what it must be. */
class Refused extends Error {}

/** The component, an instance of the WebAssembly module; one run at a time. */
class Component {
  static async load() {
    const packed = Uint8Array.from(
      atob(document.getElementById("component").textContent), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const bytes = await new Response(stream).arrayBuffer();
    const { instance } = await WebAssembly.instantiate(bytes, {});
    instance.exports._initialize();
    return new Component(instance.exports);
  }

  constructor(module) {
    this.module = module;
  }

  /** Begin a run at time 0; `settings` maps names to values, all others are at their start. */
  start(settings) {
    this.#check(this.module.start(this.#write(settings)));
  }

  set(settings) {
    this.#check(this.module.set(this.#write(settings)));
  }

  step(time, size) {
    this.#check(this.module.step(time, size));
  }

  /** Return the values of variables, a Map by name. */
  get(names) {
    const { references } = this.#buffers();
    names.forEach((name, i) => { references[i] = BY_NAME.get(name).reference; });
    this.#check(this.module.get(names.length));
    const { values } = this.#buffers();
    return new Map(names.map((name, i) => [name, values[i]]));
  }

  #write(settings) {
    const { references, values } = this.#buffers();
    [...settings].forEach(([name, value], i) => {
      references[i] = BY_NAME.get(name).reference;
      values[i] = value;
    });
    return settings.size;
  }

  // A new view for each call: memory that has grown invalidates earlier views.
  #buffers() {
    const { memory, references_buffer, values_buffer } = this.module;
    return {
      references: new Uint32Array(memory.buffer, references_buffer(), VARIABLES.length),
      values: new Float64Array(memory.buffer, values_buffer(), VARIABLES.length),
    };
  }

  #check(done) {
    if (!done) {
      const bytes = new Uint8Array(this.module.memory.buffer, this.module.refusal_text());
      throw new Refused(new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0))));
    }
  }
}
