// The map as a picture: the grid below, the robot's way, links, places with their ends, and the robot.

// Which layers are shown.
const layers = { grid: true, way: true, names: false, ellipses: true };
// Pixels of a place.
const PLACE = 9;

// Draws the view, with marks for what its last travel brought.
function drawMap(picture, view, data, choose) {
  if (!view) return refill(picture);
  const frame = boundsOf(view, data);
  look(picture, frame, `${view.map.rank} ${view.map.grid} ${view.map.measured}`);
  const way = layers.way && view.map.way?.length && view.kind !== "belief" ? wayOf(view, data) : null;
  refill(picture,
    layers.grid && view.map.grid !== undefined ? imageIn(data.grids[view.map.grid], view.kind === "belief" ? "grid faint" : "grid") : null,
    way && svg("polyline", { points: way.map(([x, y]) => `${x},${-y}`).join(" "), class: "robot-way" }),
    layers.ellipses && view.kind === "map" ? view.places.map(ellipseOf) : null,
    view.model.links.map(link => linkOf(view, data, link, choose)),
    view.model.places.map((place, number) => placeOf(view, data, place, number, choose)),
    robotOf(view));
  zoomed(picture, view.unit);
}

// The rectangle that holds everything.
function boundsOf({ map, places, model, unit }, data) {
  const used = places.slice(0, model.places.length);
  const all = [...(map.places.length >= used.length ? map.places : []), ...used];
  let [left, right] = [Math.min(...all.map(place => place.x)), Math.max(...all.map(place => place.x))];
  let [low, high] = [Math.min(...all.map(place => place.y)), Math.max(...all.map(place => place.y))];
  const image = map.grid === undefined ? null : data.grids[map.grid];
  if (image && !image.turn) {
    [left, right] = [Math.min(left, image.x), Math.max(right, image.x + image.width)];
    [low, high] = [Math.min(low, image.y), Math.max(high, image.y + image.height)];
  }
  const margin = image ? 0.5 : 0.8 * unit;
  return { x: left - margin, y: -high - margin, width: right - left + 2 * margin, height: high - low + 2 * margin };
}

// The robot's way up to the last visit of the view.
function wayOf(view, data) {
  const isAll = view.model.visits.length >= data.visits.length;
  const last = data.visits[view.robot]?.at;
  return isAll || last === undefined ? view.map.way : view.map.way.slice(0, last + 1);
}

function ellipseOf({ x, y, ellipse }) {
  if (!ellipse || !(ellipse[0] > 0)) return null;
  const [rx, ry, turn] = ellipse;
  return svg("ellipse", { rx, ry: Math.max(ry, 0.01), transform: `translate(${x} ${-y}) rotate(${(-turn * 180) / Math.PI})`, class: "ellipse" });
}

// A link leaves and enters its places in the direction of the ends; where the robot's way is known, it follows the shortest of its travels.
function linkOf(view, data, link, choose) {
  const [from, to] = link.ends.map(({ place, end }) => ({ ...view.places[place], direction: view.places[place].directions[end] }));
  const gap = apart(from, to);
  const chord = gap > 0 ? Math.atan2(to.y - from.y, to.x - from.x) : from.direction;
  const handle = (at, ahead) => {
    const reach = gap / 3 + 0.22 * Math.min(view.unit, 2 * gap || view.unit) * (1 - Math.cos(at.direction - ahead));
    return `${at.x + reach * Math.cos(at.direction)} ${-at.y - reach * Math.sin(at.direction)}`;
  };
  const way = drivenOf(view, data, link);
  const d = way
    ? `M ${way.map(([x, y]) => `${x} ${-y}`).join(" L ")}`
    : `M ${from.x} ${-from.y} C ${handle(from, chord)} ${handle(to, chord + Math.PI)} ${to.x} ${-to.y}`;
  const path = view.pathOf.get(key(link.ends[0].place, link.ends[0].end));
  const isLatest = view.kind !== "map" && link.travels.includes(view.model.visits.length - 2);
  const names = ["link", pathClass(view, path), isLatest ? "latest" : ""].filter(Boolean).join(" ");
  const label = `Way ${link.number}: ${link.ends.map(end => endName(view, data, end)).join(" to ")}, ${counted(link.travels.length, "travel")}`;
  const click = () => choose({ kind: "way", travel: link.travels[0] });
  return svg("g", { class: names, role: "button", tabindex: -1, "aria-label": label, "data-way": link.number, click, keydown: event => isPress(event) && click() },
    svg("path", { d, class: "reach" }), svg("path", { d, class: "line" }), svg("title", {}, label));
}

// The shortest of the ways that the robot drove along a link, from the middle of one place to that of the other.
function drivenOf(view, data, link) {
  if (!view.map.way?.length || !["map", "part"].includes(view.kind)) return null;
  const middle = visit => { const { x, y } = view.places[view.model.visits[visit].place]; return [x, y]; };
  const ways = link.travels.filter(travel => data.visits[travel + 1]?.at !== undefined).map(travel => {
    const [first, last] = [data.visits[travel].at, data.visits[travel + 1].at];
    return [middle(travel), ...view.map.way.slice(first, last + 1), middle(travel + 1)];
  });
  const length = way => way.slice(1).reduce((sum, [x, y], index) => sum + Math.hypot(x - way[index][0], y - way[index][1]), 0);
  return ways.length ? ways.reduce((best, way) => (length(way) < length(best) ? way : best)) : null;
}

// Colors come again dashed when they are used up; a path with a single place is gray.
function pathClass(view, number) {
  const { places, circular } = view.paths[number];
  return places.length > 1 || circular ? `path-${number % 8} dash-${Math.floor(number / 8) % 4}` : "path-single";
}

const endName = (view, data, { place, end }) => `place ${place} by ${data.stars[view.model.places[place].star].ends[end].name}`;

function placeOf(view, data, place, number, choose) {
  const { x, y, directions, double } = view.places[number];
  const star = data.stars[place.star];
  const isLatest = view.kind !== "map" && place.first === view.model.visits.length - 1;
  const names = ["place", place.first === 0 ? "start" : "", isLatest ? "latest" : "", double ? "double" : ""];
  const label = `Place ${number}, star ${star.name}, ${counted(place.visits.length, "visit")}${double ? ", beside a place that is the same one in the map it is drawn by" : ""}`;
  const ends = star.ends.map((end, index) => endOf(view, { place: number, end: index }, end, directions[index]));
  const click = () => choose({ kind: "place", visit: place.first });
  return svg("g", {
    class: names.filter(Boolean).join(" "), role: "button", "aria-label": label,
    "data-place": number, "data-at": `${x} ${-y}`, click, keydown: event => isPress(event) && click(),
  }, ends, svg("circle", { r: PLACE + 4, class: "halo" }), svg("circle", { r: PLACE }), svg("text", { y: 3.5, class: "number" }, String(number)),
    layers.names ? svg("text", { y: -16, class: "name" }, star.name) : null, svg("title", {}, label));
}

// Marks what is chosen. Tab comes to one place only: that one, or the first.
function markMap(picture, chosen) {
  const number = chosen?.kind === "place" || chosen?.kind === "visit" ? chosen.place : null;
  for (const place of picture.querySelectorAll("[data-place]")) {
    const isChosen = Number(place.dataset.place) === number;
    place.classList.toggle("chosen", isChosen);
    place.setAttribute("aria-pressed", String(isChosen));
    place.setAttribute("tabindex", isChosen || (number === null && place.dataset.place === "0") ? 0 : -1);
  }
  for (const way of picture.querySelectorAll("[data-way]")) way.classList.toggle("chosen", chosen?.kind === "way" && chosen.link.number === Number(way.dataset.way));
}

// A closed end is a bar, a pending gateway an arrow into the open; a link is drawn by itself.
function endOf(view, at, end, direction) {
  const [x, y] = [Math.cos(direction), -Math.sin(direction)];
  if (view.model.linkOf.has(key(at.place, at.end))) return null;
  const arm = (reach, name) => svg("line", { x1: PLACE * x, y1: PLACE * y, x2: reach * x, y2: reach * y, class: name });
  if (!end.closed) return [arm(20, "pending"), arrow(23 * x, 23 * y, direction, "pending-head")];
  return [arm(15, "stop"), svg("line", { x1: 15 * x - 5 * y, y1: 15 * y + 5 * x, x2: 15 * x + 5 * y, y2: 15 * y - 5 * x, class: "stop" })];
}

// The robot stands at the last visit, and looks away from where it came from.
function robotOf(view) {
  const visit = view.model.visits[view.robot];
  const { x, y, directions } = view.places[visit.place];
  const direction = visit.entry === undefined ? 0 : directions[visit.entry] + Math.PI;
  const mark = svg("path", { d: "M 14 0 L -6 8 L -2 0 L -6 -8 Z", transform: `translate(0 -22) rotate(${(-direction * 180) / Math.PI})` });
  return svg("g", { class: "robot", "data-at": `${x} ${-y}`, "aria-hidden": "true" }, mark);
}

// The robot as it is now, while it drives, and what its laser hits; the mark of the last visit makes way for it.
function markRobot(picture, now) {
  picture.querySelector(".robot-now")?.remove();
  picture.classList.toggle("driving", Boolean(now?.pose));
  if (!now?.pose || !state.view?.map.measured) return;
  const [x, y, theta] = now.pose;
  const scale = Number(picture.querySelector(".robot")?.getAttribute("transform")?.match(/scale\((.*)\)/)?.[1] ?? 0.05);
  picture.append(svg("g", { class: "robot-now", "aria-hidden": "true" },
    (now.hits ?? []).map(([hx, hy]) => svg("circle", { cx: hx, cy: -hy, r: 0.06, class: "hit" })),
    svg("path", { d: "M 12 0 L -7 8 L -3 0 L -7 -8 Z", transform: `translate(${x} ${-y}) rotate(${(-theta * 180) / Math.PI}) scale(${scale})` })));
}

