// A slider reports one position at a time: while the answer is under way only the latest position is kept. So a fast
// hand never runs ahead of a slow machine.
let isUnderWay = false;
let latest = null;
let patience;

function report(emit, position) {
  if (isUnderWay) {
    latest = [emit, position];
    return;
  }
  isUnderWay = true;
  patience = setTimeout(goOn, 3000);
  emit(position);
}

function goOn() {
  clearTimeout(patience);
  isUnderWay = false;
  if (latest === null) return;
  const next = latest;
  latest = null;
  report(...next);
}

// Ends an answer: places the thumbs of sliders, [id, steps, position, text] each.
function slideTo(thumbs) {
  for (const [id, steps, position, text] of thumbs) {
    const slider = document.getElementById(id);
    if (!slider) continue;
    slider.max = steps;
    // The slider in use is ahead of what is known about it elsewhere.
    if (slider !== document.activeElement) slider.value = position;
    slider.setAttribute("aria-valuetext", text);
  }
  requestAnimationFrame(() => setTimeout(goOn));
}

// Puts the text of an element on the clipboard, and says so on the button.
async function copyText(id, button) {
  const element = document.getElementById(id);
  if (navigator.clipboard) {
    await navigator.clipboard.writeText(element.textContent);
  } else {
    // Browsers lend the clipboard only to pages of the same machine, or over https.
    getSelection().selectAllChildren(element);
    document.execCommand("copy");
  }
  const label = button.querySelector(".block");
  const before = label.textContent;
  label.textContent = "Copied";
  setTimeout(() => (label.textContent = before), 1500);
}
