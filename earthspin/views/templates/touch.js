// A picture that is turned with the mouse, a finger or the arrow keys. The wheel and a finger
// scroll the page until the picture is touched.
"use strict";

// `turn` takes radians to the right and up, `zoom` a factor; `keys` adds keys to those that turn.
function makeTouchable(canvas, turn, zoom, keys) {
  const touched = (yes) => canvas.classList.toggle("touched", yes);
  const all = {
    ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0),
    ArrowUp: () => turn(0, -0.1), ArrowDown: () => turn(0, 0.1),
    "+": () => zoom(1.15), "-": () => zoom(1 / 1.15), Escape: () => touched(false), ...keys,
  };
  canvas.addEventListener("keydown", (e) => {
    if (!all[e.key] || e.ctrlKey || e.metaKey || e.altKey) return;
    e.preventDefault();
    all[e.key]();
  });
  canvas.addEventListener("click", () => touched(true));
  addEventListener("pointerdown", (e) => { if (e.target !== canvas) touched(false); });
  canvas.addEventListener("pointerdown", (e) => {
    if (e.pointerType === "mouse") touched(true);
    if (canvas.classList.contains("touched")) canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener("pointermove", (e) => {
    if (e.buttons && canvas.classList.contains("touched")) turn(e.movementX / 150, e.movementY / 150);
  });
  canvas.addEventListener("wheel", (e) => {
    if (!canvas.classList.contains("touched")) return;
    e.preventDefault();
    zoom(Math.exp(-e.deltaY / 600));
  }, { passive: false });
}
