// Which part of the plane a picture shows: x, y and sizes in metres, y downwards. It is moved by the pointer and zoomed; keys go from point to point.

// The reader's own part stays until another map is drawn. `dragged`, how many pixels the picture was moved since the pointer went down.
const camera = { box: null, whole: null, of: null, isOwn: false, dragged: 0 };

const wasDragged = () => camera.dragged > 4;

// How long, in pixels, a link between two symbols is that are drawn as large as they are meant.
const ROOMY = 44;
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

// Shows a whole frame, unless the reader looks at a part of the same picture.
function look(picture, frame, id) {
  if (!camera.isOwn || camera.of !== id) Object.assign(camera, { box: fitted(frame, picture), of: id, isOwn: false });
  camera.whole = frame;
}

// The same rectangle in the shape of the picture.
function fitted({ x, y, width, height }, picture) {
  const shape = (picture.clientWidth || 800) / (picture.clientHeight || 500);
  const [wide, tall] = width / height > shape ? [width, width / shape] : [height * shape, height];
  return { x: x + (width - wide) / 2, y: y + (height - tall) / 2, width: wide, height: tall };
}

// Sets what part is seen; symbols keep their size on the screen as far as there is room for them.
function zoomed(picture, unit) {
  const { x, y, width, height } = camera.box;
  picture.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
  const pixel = width / (picture.clientWidth || 800);
  const room = Math.min(1.3, Math.max(0.3, unit / pixel / ROOMY));
  picture.classList.toggle("crowded", room < 0.6);
  for (const node of picture.querySelectorAll("[data-at]")) node.setAttribute("transform", `translate(${node.dataset.at}) scale(${pixel * room})`);
}

// Zooms by a factor, or shows everything.
function zoom(picture, unit, factor) {
  camera.isOwn = factor !== null;
  if (!factor) camera.box = fitted(camera.whole, picture);
  else {
    const { x, y, width, height } = camera.box;
    camera.box = { x: x + (width * (1 - factor)) / 2, y: y + (height * (1 - factor)) / 2, width: width * factor, height: height * factor };
  }
  zoomed(picture, unit);
}

function zoomButtons(picture, unit) {
  return [
    button("+", () => zoom(picture, unit, 1 / 1.4), { "aria-label": "Zoom in" }),
    button("−", () => zoom(picture, unit, 1.4), { "aria-label": "Zoom out" }),
    button("◻", () => zoom(picture, unit, null), { "aria-label": "Show everything" }),
  ];
}

const isPress = event => (event.key === "Enter" || event.key === " ") && (event.preventDefault(), true);

// Arrows go from the point with the number `at` to the one next to it, or to the first; they choose it by `to`, Escape chooses nothing.
function goByKey(event, picture, unit, { points, at, to, none }) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (ARROWS[event.key]) {
    event.preventDefault();
    const next = at === null ? 0 : neighborTowards(points, at, ARROWS[event.key]);
    if (next !== null && next < points.length) to(next);
    picture.querySelector(".place.chosen")?.focus();
  } else if (event.key === "+" || event.key === "=") zoom(picture, unit, 1 / 1.4);
  else if (event.key === "-") zoom(picture, unit, 1.4);
  else if (event.key === "0") zoom(picture, unit, null);
  else if (event.key === "Escape") none();
}

// The point next to one in a direction: the nearest within a right angle.
function neighborTowards(points, number, [dx, dy]) {
  const here = points[number];
  let best = null;
  points.forEach((point, other) => {
    const [x, y] = [point.x - here.x, point.y - here.y];
    const ahead = x * dx + y * dy;
    const aside = Math.abs(x * dy - y * dx);
    if (other === number || ahead <= 0 || aside > ahead) return;
    const cost = ahead + 2 * aside;
    if (!best || cost < best.cost) best = { other, cost };
  });
  return best?.other ?? null;
}

// The picture is dragged with the pointer, by its ground and by areas, and zoomed by the wheel while a control key is down.
function watchPointer(picture, unit, resized) {
  let last = null;
  picture.addEventListener("pointerdown", event => {
    camera.dragged = 0;
    const held = event.target.closest("[role=button]");
    if (event.isPrimary && (!held || held.classList.contains("area"))) last = event;
  });
  window.addEventListener("pointermove", event => {
    if (!last || !camera.box) return;
    const pixel = camera.box.width / picture.clientWidth;
    camera.box.x -= (event.clientX - last.clientX) * pixel;
    camera.box.y -= (event.clientY - last.clientY) * pixel;
    camera.dragged += Math.abs(event.clientX - last.clientX) + Math.abs(event.clientY - last.clientY);
    last = event;
    camera.isOwn = true;
    picture.setAttribute("viewBox", `${camera.box.x} ${camera.box.y} ${camera.box.width} ${camera.box.height}`);
  });
  for (const end of ["pointerup", "pointercancel"]) window.addEventListener(end, () => { last = null; });
  picture.addEventListener("wheel", event => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    if (camera.box) zoom(picture, unit(), event.deltaY > 0 ? 1.15 : 1 / 1.15);
  }, { passive: false });
  window.addEventListener("resize", () => { camera.isOwn = false; resized(); });
}

