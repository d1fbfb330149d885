// The map with what belongs to it: choosing among the ranking, layers, zoom, keys.

function drawMapCard(view) {
  const picture = byId("map-picture");
  byId("map-card").classList.toggle("empty", !view);
  byId("map-caption").textContent = view ? view.title : "There is no map to draw.";
  refill(byId("map-flip"), flipping());
  refill(byId("map-layers"), view ? switches(view) : null);
  refill(byId("map-zoom"), view ? zoomButtons(picture, view.unit) : null);
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
  const number = event.target.closest?.("[data-place]")?.dataset.place;
  goByKey(event, picture, view.unit, {
    points: view.places.slice(0, view.model.places.length), at: number === undefined ? null : Number(number),
    to: next => choose({ kind: "place", visit: view.model.places[next].first }), none: () => choose(null),
  });
}

