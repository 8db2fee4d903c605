// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { byId, el, setText } from "./dom.js";
import { Inspector } from "./inspector.js";
import { markOf } from "./system_view.js";

/** The page of whoever writes a component: all components in a list, and everything about one of them. */
export class ComponentView {
  /**
   * @param {import("./connection.js").Connection} connection
   * @param {import("./system_model.js").SystemModel} system
   */
  constructor(connection, system) {
    this.system = system;
    this.list = byId("component-list");
    this.chosen = "";
    this.isShown = false;
    this.inspector = new Inspector(byId("component"), connection, system, (choice) => this.follow(choice));
    system.addEventListener("figures", () => this.refresh());
  }

  /** @param {boolean} on */
  show(on) {
    this.isShown = on;
    this.inspector.show(on && this.chosen !== "" ? { component: this.chosen } : null);
    this.refresh();
  }

  /** @param {import("./system_view.js").Choice} choice */
  follow(choice) {
    if (choice !== null && "component" in choice) this.choose(choice.component);
    else this.inspector.show(choice);
  }

  /** @param {string} name */
  choose(name) {
    this.chosen = name;
    this.inspector.show({ component: name });
    this.refresh();
  }

  refresh() {
    if (!this.isShown) return;
    const components = [...this.system.components.values()];
    if (this.chosen === "" && components.length > 0) return this.choose(components[0].name);
    const names = components.map((component) => component.name).join();
    if (this.list.dataset.names !== names) {
      this.list.replaceChildren(...components.map(({ name }) => el("button", { class: "plain", "data-name": name, click: () => this.choose(name) })));
      this.list.dataset.names = names;
    }
    for (const button of /** @type {NodeListOf<HTMLElement>} */ (this.list.querySelectorAll("button"))) {
      const component = this.system.components.get(button.dataset.name ?? "");
      const [mark, kind] = markOf(component?.state ?? "");
      setText(button, `${mark} ${component?.name}${component?.alarms ? " !" : ""}`);
      button.dataset.state = kind;
      button.setAttribute("aria-current", String(component?.name === this.chosen));
    }
  }
}
