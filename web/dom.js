// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

/** Elements of the page. Whatever comes from the system is put in as text, never as HTML. */

/** @param {string} id @returns {HTMLElement} the element of index.html with this id */
export function byId(id) {
  const found = document.getElementById(id);
  if (found === null) throw new Error(`index.html has no element #${id}`);
  return found;
}

/**
 * Makes an element.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, string | number | boolean | ((event: any) => void)>} [attributes]  a function is a listener for the event
 *   of that name; false leaves the attribute out
 * @param {...(Node | string | null)} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function el(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name, value);
    else if (value !== false) made.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children) if (child !== null) made.append(child);
  return made;
}

/**
 * Makes an element of a drawing.
 * @template {keyof SVGElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, string | number>} [attributes]
 * @param {...Node} children
 * @returns {SVGElementTagNameMap[K]}
 */
export function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

/**
 * Sets a text if it has changed, so that the browser lays out no more than necessary.
 * @param {Node} node
 * @param {string} text
 */
export function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

/**
 * Lets a control be used, or shows why not where the pointer stands on it.
 * @param {HTMLElement} control  a button, a box or a list
 * @param {string} refusal  "": it may be used
 */
export function permit(control, refusal) {
  /** @type {HTMLButtonElement} */ (control).disabled = refusal !== "";
  control.dataset.title ??= control.title;
  const title = refusal === "" ? control.dataset.title : refusal;
  if (control.title !== title) control.title = title;
}

/** @param {string} text @returns {string} the text for an attribute in double quotes */
export function xmlText(text) {
  return text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/"/g, "&quot;").replace(/\n/g, "&#10;");
}

/**
 * Shows a message for some seconds, longer if it is an error.
 * @param {string} text
 * @param {"done" | "refused" | "note"} [kind]
 */
export function notify(text, kind = "note") {
  const shown = el("div", { class: `notice ${kind}`, role: kind === "refused" ? "alert" : "status" }, text);
  shown.append(el("button", { class: "plain", "aria-label": "Close this message", click: () => shown.remove() }, "×"));
  const notices = byId("notices");
  notices.append(shown);
  while (notices.childElementCount > 4) notices.firstElementChild?.remove();
  setTimeout(() => shown.remove(), kind === "refused" ? 15000 : 4000);
}

/** @param {number | null | undefined} value @param {number} [digits] @returns {string} the number with so many digits after the point */
export function figure(value, digits = 2) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  return value.toFixed(digits).replace(/^-(?=[0.]*$)/, "").replace("-", "−");
}
