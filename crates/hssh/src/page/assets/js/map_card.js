// The map with what belongs to it: choosing among the ranking, layers, zoom, keys.

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

function drawMapCard(view) {
  const picture = byId("map-picture");
  byId("map-card").classList.toggle("empty", !view);
  byId("map-caption").textContent = view ? view.title : "There is no map to draw.";
  refill(byId("map-flip"), flipping());
  refill(byId("map-layers"), view ? switches(view) : null);
  refill(byId("map-zoom"), view ? [
    button("+", () => zoom(picture, view.unit, 1 / 1.4), { "aria-label": "Zoom in" }),
    button("−", () => zoom(picture, view.unit, 1.4), { "aria-label": "Zoom out" }),
    button("◻", () => zoom(picture, view.unit, null), { "aria-label": "Show everything" }),
  ] : null);
  const hadFocus = picture.contains(document.activeElement);
  drawMap(picture, view, state.data, choose);
  markMap(picture, chosenIn(view, state.chosen));
  markRobot(picture, state.robot);
  if (hadFocus) (picture.querySelector(".place.chosen") ?? picture.querySelector(".place[tabindex='0']"))?.focus();
  refill(byId("map-legend"), view ? legend(view) : null);
  picture.onkeydown = event => view && onKey(event, view, picture);
}

// One map before, or after, in the ranking.
function flipping() {
  const { maps } = state.data;
  if (maps.length < 2) return null;
  const index = maps.findIndex(map => map.rank === state.rank);
  const to = step => () => show({ rank: maps[index + step].rank, travel: Infinity, node: null });
  return [
    button("◀", to(-1), { "aria-label": "Map before in the ranking", id: "map-before", disabled: index === 0 || null }),
    element("span", { class: "which" }, ` map ${state.rank} of ${maps.length} `),
    button("▶", to(1), { "aria-label": "Next map of the ranking", id: "map-next", disabled: index === maps.length - 1 || null }),
  ];
}

function switches(view) {
  const has = { grid: view.map.grid !== undefined, way: view.map.way?.length > 0, ellipses: view.map.places.some(place => place.ellipse), names: true };
  const words = { grid: "building", way: "robot's way", ellipses: "where places are, to 95 %", names: "names of stars" };
  return Object.keys(words).filter(layer => has[layer]).map(layer => element("label", {},
    element("input", { type: "checkbox", id: `layer-${layer}`, checked: layers[layer], change: event => { layers[layer] = event.target.checked; render(); } }),
    ` ${words[layer]}`));
}

function legend(view) {
  const line = (name, words) => element("span", {}, svg("svg", { viewBox: "0 0 24 12", class: "sample" }, name), ` ${words}`);
  return [
    line([svg("circle", { cx: 12, cy: 6, r: 5, class: "place-sample" })], "place"),
    line([svg("line", { x1: 1, y1: 6, x2: 23, y2: 6, class: "link-sample" })], "way; one color, one path"),
    line([svg("line", { x1: 1, y1: 6, x2: 14, y2: 6, class: "pending" }), svg("path", { d: "M 22 6 L 13 10 L 13 2 Z", class: "pending-head" })], "pending gateway"),
    line([svg("line", { x1: 3, y1: 6, x2: 17, y2: 6, class: "stop" }), svg("line", { x1: 17, y1: 1, x2: 17, y2: 11, class: "stop" })], "closed end"),
    line([svg("path", { d: "M 22 6 L 4 11 L 8 6 L 4 1 Z", class: "robot-sample" })], view.kind === "map" ? "robot at the end" : "robot then"),
  ];
}

function onKey(event, view, picture) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const number = event.target.closest?.("[data-place]")?.dataset.place;
  if (ARROWS[event.key]) {
    event.preventDefault();
    const next = number === undefined ? 0 : neighborTowards(view, Number(number), ARROWS[event.key]);
    if (next !== null) choose({ kind: "place", visit: view.model.places[next].first });
    picture.querySelector(".place.chosen")?.focus();
  } else if (event.key === "+" || event.key === "=") zoom(picture, view.unit, 1 / 1.4);
  else if (event.key === "-") zoom(picture, view.unit, 1.4);
  else if (event.key === "0") zoom(picture, view.unit, null);
  else if (event.key === "Escape") choose(null);
}

// The picture is dragged with the pointer, and zoomed by the wheel while a control key is down.
function watchPointer(picture) {
  let last = null;
  picture.addEventListener("pointerdown", event => {
    if (event.isPrimary && !event.target.closest("[role=button]")) last = event;
  });
  window.addEventListener("pointermove", event => {
    if (!last || !camera.box) return;
    const pixel = camera.box.width / picture.clientWidth;
    camera.box.x -= (event.clientX - last.clientX) * pixel;
    camera.box.y -= (event.clientY - last.clientY) * pixel;
    last = event;
    camera.isOwn = true;
    picture.setAttribute("viewBox", `${camera.box.x} ${camera.box.y} ${camera.box.width} ${camera.box.height}`);
  });
  for (const end of ["pointerup", "pointercancel"]) window.addEventListener(end, () => { last = null; });
  picture.addEventListener("wheel", event => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    if (state.view) zoom(picture, state.view.unit, event.deltaY > 0 ? 1.15 : 1 / 1.15);
  }, { passive: false });
  window.addEventListener("resize", () => { camera.isOwn = false; drawMapCard(state.view); });
}

