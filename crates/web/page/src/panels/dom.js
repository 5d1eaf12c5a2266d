// Makes elements, and follows changes, for all panels.

/** @typedef {string | number | boolean | null | undefined | ((event: any) => void)} Value */

/**
 * An HTML element. A function among the attributes listens to the event of that name.
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {Record<string, Value>} [attributes]
 * @param {...(Node | string)} children
 * @returns {HTMLElementTagNameMap[T]}
 */
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  assign(element, attributes);
  element.append(...children);
  return element;
}

/**
 * An SVG element.
 * @template {keyof SVGElementTagNameMap} T
 * @param {T} tag
 * @param {Record<string, Value>} [attributes]
 * @param {...(Node | string)} children
 * @returns {SVGElementTagNameMap[T]}
 */
export function s(tag, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  assign(element, attributes);
  element.append(...children);
  return element;
}

/** @param {Element} element @param {Record<string, Value>} attributes */
function assign(element, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) {
      element.setAttribute(name, String(value));
    }
  }
}

/**
 * The element of the page with this id.
 * @template {Element} T
 * @param {string} id
 * @param {new () => T} kind
 * @returns {T}
 */
export function part(id, kind) {
  const element = document.getElementById(id);
  if (!(element instanceof kind)) throw new Error(`The page has no ${id}.`);
  return element;
}

/**
 * Calls `then` with the detail of each change of `target`.
 * @param {EventTarget} target
 * @param {(detail: any) => void} then
 */
export function changes(target, then) {
  target.addEventListener("change", (event) => then(/** @type {CustomEvent} */ (event).detail ?? {}));
}

/**
 * A function that runs `work` in the next frame, once, however often it is called before.
 * @param {() => void} work
 */
export function eachFrame(work) {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      work();
    });
  };
}

/** Sets an element's text if it changed, so that nothing is laid out again for nothing.
 *  @param {Element} element @param {string} text */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/**
 * A labeled line of a form.
 * @param {string} label
 * @param {HTMLElement} control
 */
export function field(label, control) {
  return h("label", { class: "field" }, h("span", { class: "field-label" }, label), control);
}

/**
 * A select of these options.
 * @param {Record<string, string>} options label by value
 * @param {(value: string) => void} chosen
 * @param {Record<string, Value>} [attributes]
 */
export function select(options, chosen, attributes = {}) {
  const list = Object.entries(options).map(([value, label]) => h("option", { value }, label));
  const element = h("select", attributes, ...list);
  element.addEventListener("change", () => chosen(element.value));
  return element;
}
