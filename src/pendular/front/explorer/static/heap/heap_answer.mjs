// What the solver says to the question of a heap: all that the view of it shows.

import { answersAt, membersOf, settingOf, wettedOf } from "./wetted.mjs";
import { heapQuestionOf } from "./heap_view.mjs";

const REDUCED = [0.1, 1000]; // ΔpR/γ at the ends of the curve and of the slider, with the mean radius
const RAISED = 10 ** 0.5; // by which the lower end is raised where the cell is too small for its bridges

/** The answer to a view; what the suction does not change is taken from the answer before, if that had it. */
export function heapAnswerTo(view, own, solver, before) {
  const question = heapQuestionOf(view, own);
  const { heap, angle, liquid, suction } = question;
  const isSame =
    before?.question.heap === heap &&
    before.question.angle === angle &&
    before.question.liquid.surfaceTension === liquid.surfaceTension &&
    before.setting.leastSuction <= suction;
  const setting = isSame ? before.setting : widestSetting(question, solver);
  const answers = isSame && before.answers.suction === suction ? before.answers : answersAt(setting, suction, solver);
  const onWetting = membersOf(answers, "wetting");
  const members = view.path === "wetting" ? onWetting : membersOf(answers, "drying");
  const isFormed = new Set(onWetting);
  const bridges = members.map((row) => ({ row, isKept: !isFormed.has(row) }));
  return { view, question, setting, answers, bridges, values: wettedOf(setting, answers, members) };
}

/** Ends of the curve and of the slider, [Pa]. */
export function rangeOf({ question, setting }) {
  const unit = question.liquid.surfaceTension / question.heap.meanRadius;
  return { low: Math.max(REDUCED[0] * unit, setting.curveFrom), high: REDUCED[1] * unit };
}

/** The setting for the suction and for the curve, as far down as the cell lets bridges reach. */
function widestSetting({ heap, angle, liquid, suction }, solver) {
  const unit = liquid.surfaceTension / heap.meanRadius;
  const asked = (least) => settingOf(heap, angle, liquid.surfaceTension, least, solver);
  for (let low = REDUCED[0] * unit; low < suction; low *= RAISED) {
    try {
      return Object.assign(asked(low), { curveFrom: low });
    } catch (error) {
      if (!(error instanceof RangeError && error.message.startsWith("cell:"))) throw error;
    }
  }
  return Object.assign(asked(suction), { curveFrom: suction });
}
