// Own grains: pasted into a field, dropped on it, or read from a file.

/** Take grains: `use` is given their text and its unit, and throws a RangeError in one line if they are none. */
export function takeGrains(at, use) {
  const [text, file, wrong] = ["text", "file", "text-wrong"].map(at);
  const take = () => {
    try {
      use({ text: text.value, unit: at("unit").value.trim() });
      wrong.textContent = "";
      text.removeAttribute("aria-invalid");
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      wrong.textContent = error.message;
      text.setAttribute("aria-invalid", "true");
    }
  };
  const read = async (chosen) => {
    if (!chosen) return;
    text.value = await chosen.text();
    take();
  };
  at("use").addEventListener("click", take);
  file.addEventListener("click", () => (file.value = "")); // the same file may have changed
  file.addEventListener("change", () => read(file.files[0]));
  text.addEventListener("dragover", (event) => event.preventDefault());
  text.addEventListener("drop", (event) => {
    if (!event.dataTransfer.files.length) return; // a text is dropped as ever
    event.preventDefault();
    read(event.dataTransfer.files[0]);
  });
}
