// Fields: a label, a text with its unit, a slider beside it, and what is wrong with the text.

/** A field by its name on the page; `list` is a list of words to choose from, which has no slider. */
export function fieldBox(name, label, list = "") {
  const field = document.createElement("div");
  field.className = "field";
  field.innerHTML =
    `<label for="text-${name}">${label}</label>` +
    `<input id="text-${name}" type="text" spellcheck="false" autocapitalize="off" autocomplete="off" aria-describedby="wrong-${name}"${list && ` list="${list}"`}>` +
    (list ? "" : `<input id="slider-${name}" type="range" min="0" max="1000" step="1">`) +
    `<p class="wrong" id="wrong-${name}" role="alert"></p>`;
  const slider = field.querySelector("[type=range]");
  slider?.setAttribute("aria-label", label);
  return {
    field,
    label: field.querySelector("label"),
    text: field.querySelector("input"),
    slider,
    wrong: field.querySelector(".wrong"),
    isRefused: false,
  };
}

/** Show what cannot be, and why. */
export function markWrong(field, text, error) {
  field.isRefused = true;
  field.text.value = text;
  field.text.setAttribute("aria-invalid", "true");
  field.wrong.textContent = error.message;
}

export function markRight(field) {
  field.isRefused = false;
  field.text.removeAttribute("aria-invalid");
  field.wrong.textContent = "";
}
