// A fit beside the page, which goes on answering: it is asked by a message, and answers by one.

import { fitOf } from "./fit_search.mjs";
import { load } from "./pendular.mjs";

let loaded; // the solver, from the first message on

addEventListener("message", async ({ data: { module, request } }) => {
  try {
    loaded ??= load(module);
    postMessage({ fit: fitOf(request, await loaded) });
  } catch (error) {
    postMessage({ wrong: error instanceof RangeError ? error.message : `the fit failed: ${error.message}` });
  }
});
