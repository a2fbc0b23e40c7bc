"use strict";
for (const box of document.querySelectorAll(".wipe")) {
  const bar = box.parentElement.querySelector("input");
  const show = (value) => {
    bar.value = value;
    box.style.setProperty("--at", bar.value + "%");
    bar.setAttribute("aria-valuetext", Math.round(bar.value) + " % expected");
  };
  const follow = (event) => {
    const place = box.getBoundingClientRect();
    show((100 * (event.clientX - place.left)) / place.width);
  };
  bar.addEventListener("input", () => show(bar.value));
  box.addEventListener("pointerdown", (event) => { box.setPointerCapture(event.pointerId); follow(event); });
  box.addEventListener("pointermove", (event) => { if (event.buttons || event.pointerType === "mouse") follow(event); });
  show(50);
}
