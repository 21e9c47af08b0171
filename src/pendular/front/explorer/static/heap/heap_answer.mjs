// What the solver says to the question of a heap: all that the view of it shows.

import { answersAt, membersOf, settingOf, wettedOf } from "./wetted.mjs";
import { heapQuestionOf } from "./heap_view.mjs";
import { show } from "../units.mjs";

const REDUCED = [0.1, 1000]; // ΔpR/γ at the ends of the curve and of the slider, with the mean radius
const USUAL = 10; // as the command has it
const RAISED = 10 ** 0.5; // by which the lower end is raised where the cell is too small for its bridges

/** The answer to a view; what the suction does not change is taken from the answer before, if that had it. */
export function heapAnswerTo(view, own, solver, before) {
  const question = heapQuestionOf(view, own);
  const { heap, angle, liquid, suction } = question;
  const isSame =
    before?.question.heap === heap &&
    before.question.angle === angle &&
    before.question.condensation === question.condensation &&
    before.question.liquid.surfaceTension === liquid.surfaceTension &&
    before.setting.leastSuction <= suction;
  const setting = isSame ? before.setting : widestSetting(question, solver);
  const answers = isSame && before.answers.suction === suction ? before.answers : answersAt(setting, suction, solver);
  const onWetting = membersOf(answers, "wetting");
  const members = view.path === "wetting" ? onWetting : membersOf(answers, "drying");
  const isFormed = new Set(onWetting);
  const bridges = members.map((row) => ({ row, isKept: !isFormed.has(row) }));
  const values = wettedOf(setting, answers, members);
  return { view, question, setting, answers, bridges, values, notices: noticesOf(setting, suction, solver) };
}

/** Where grains overlap by more than a bridge spans, or the digits of their centres tell no such gap. */
function noticesOf({ heap, pairs, angle, surfaceTension }, suction, solver) {
  let deepest = 0;
  for (let row = 1; row < pairs.count; row++) if (pairs.gap[row] < pairs.gap[deepest]) deepest = row;
  const overlap = Math.max(0, -(pairs.gap[deepest] ?? 0));
  if (Math.max(overlap, 2 * heap.cut) <= heap.rounding) return [];
  const radius = [pairs.first, pairs.second].map((bodies) => heap.radii[bodies[deepest] ?? 0]);
  const spanned = solver.rupture({ radius, contactAngle: angle }, { suction, surfaceTension })?.separation ?? 0;
  const [deep, cut, long, at] = [overlap, 2 * heap.cut, spanned]
    .map((one) => show(one, "m", 3))
    .concat(show(suction, "Pa", 4));
  if (overlap > spanned)
    return [
      `Grains overlap by up to ${deep}, more than a bridge spans at ${at}, ${long}: with noise of that size gaps look too wide and the stress is too low.`,
    ];
  if (2 * heap.cut > spanned)
    return [
      `The digits of the centres tell gaps to ${cut}, no better than a bridge spans at ${at}, ${long}: contacts look open and the stress is too low.`,
    ];
  return [];
}

/** Ends of the curve and of the slider, [Pa]. */
export function rangeOf({ question, setting }) {
  const unit = question.liquid.surfaceTension / question.heap.meanRadius;
  return { low: Math.max(REDUCED[0] * unit, setting.curveFrom), high: REDUCED[1] * unit };
}

/** The usual suction for grains, where that of a view is far from what holds bridges between them, [Pa]. */
export function usualSuction(view, own) {
  const { heap, liquid, suction } = heapQuestionOf(view, own);
  const unit = liquid.surfaceTension / heap.meanRadius;
  return suction >= REDUCED[0] * unit && suction <= REDUCED[1] * unit ? undefined : USUAL * unit;
}

/** The setting for the suction and for the curve, as far down as the cell lets bridges reach. */
function widestSetting({ heap, angle, liquid, suction, condensation }, solver) {
  const unit = liquid.surfaceTension / heap.meanRadius;
  const asked = (least) => settingOf(heap, angle, liquid.surfaceTension, least, solver, condensation);
  for (let low = REDUCED[0] * unit; low < suction; low *= RAISED) {
    try {
      return Object.assign(asked(low), { curveFrom: low });
    } catch (error) {
      if (!(error instanceof RangeError && error.message.startsWith("cell:"))) throw error;
    }
  }
  return Object.assign(asked(suction), { curveFrom: suction });
}
