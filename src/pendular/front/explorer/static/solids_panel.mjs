// The panel of the solids: which of their fields are seen, and what another kind of solid changes in a view.

import { ENDINGS, fieldsOfKind, hasOthers, KINDS_OF_SOLIDS, labelOfRadius } from "./kinds.mjs";
import { FIRST_VIEW, isPlane } from "./view.mjs";

const OF_SOLIDS = ["radius", "half-angle", "tip-radius"];

export const SOLID_LABELS = Object.fromEntries(
  ENDINGS.flatMap((ending) =>
    Object.entries({ radius: "Radius", "half-angle": "Half angle", "tip-radius": "Tip radius" }).map(
      ([name, label]) => [name + ending, `${label} ${ending || 1}`],
    ),
  ),
);

const shownKind = (view, ending) => {
  const kind = view[`kind${ending}`];
  return kind === "sphere" && isPlane(view[`radius${ending}`]) ? "plane" : kind;
};

/** Fill the choices of a kind; `chosen` is told the field that a change belongs to, and the change. */
export function layOutKinds(viewNow, chosen) {
  for (const ending of ENDINGS) {
    const choice = document.getElementById(`kind${ending}`);
    choice.innerHTML = KINDS_OF_SOLIDS.map((kind) => `<option>${kind}</option>`).join("");
    choice.addEventListener("change", () => {
      const before = fieldsOfKind(viewNow()[`kind${ending}`])[0] + ending;
      chosen(before, changesTo(choice.value, ending, viewNow()));
    });
  }
}

/** What a view has to change for another kind of solid. */
function changesTo(kind, ending, view) {
  const radius = `radius${ending}`;
  const other = view[ending ? "radius" : "radius2"];
  const length = isPlane(view[radius]) ? (isPlane(other) ? FIRST_VIEW.radius : other) : view[radius];
  const changes = { [`kind${ending}`]: kind === "plane" ? "sphere" : kind, [radius]: kind === "plane" ? "plane" : length };
  if (hasOthers({ ...view, ...changes })) {
    if (Number.parseFloat(view.separation.replace("−", "-")) < 0) changes.separation = "0 m";
    if (!["force", "rupture"].includes(view.map)) changes.map = "force"; // all else are errors of laws
  }
  return changes;
}

/** Show the fields that a view has, under their names. */
export function showKinds(view, fields) {
  for (const ending of ENDINGS) {
    const kind = shownKind(view, ending);
    document.getElementById(`kind${ending}`).value = kind;
    const seen = kind === "plane" ? [] : fieldsOfKind(kind);
    for (const name of OF_SOLIDS) fields[name + ending].field.hidden = !seen.includes(name);
    const { label, slider } = fields[`radius${ending}`];
    label.textContent = `${labelOfRadius(kind)} ${ending || 1}`;
    slider.setAttribute("aria-label", label.textContent);
  }
  const isSilent = hasOthers(view);
  document.getElementById("pair-view").classList.toggle("lawless", isSilent);
  for (const option of document.getElementById("map-choice").options)
    option.disabled = isSilent && !["force", "rupture"].includes(option.value);
}
