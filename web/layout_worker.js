// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { arrange } from "./system_layout.js";
import "/lib/dagre.min.js";

/** Arranges graphs beside the page, which stays quick meanwhile: a large graph takes seconds, and STOP may not wait for that. */
addEventListener("message", (event) => {
  const { number, plan } = event.data;
  try {
    postMessage({ number, places: arrange(/** @type {any} */ (globalThis).dagre, plan), error: "" });
  } catch (error) {
    postMessage({ number, places: {}, error: String(error) });
  }
});
