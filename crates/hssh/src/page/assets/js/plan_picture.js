// The plan as a picture: the grid below, regions over it, ways, passages, and places on top.

const layers = { grid: true, regions: true, ways: true, names: true };

// Pixels of a place.
const PLACE = 8;

function drawPlan(picture) {
  const { account, data } = state;
  look(picture, planFrame(data.grid), account.name);
  refill(picture,
    layers.grid && imageIn(data.grid, "grid"),
    layers.regions && account.regions.map(areaOf),
    layers.ways && account.connections.map(walkOf),
    account.passages.map(passageOf),
    account.places.map(spotOf),
    layers.names && layers.regions && account.regions.map(areaName));
  zoomed(picture, planUnit());
  markPlan(picture);
}

function planFrame({ x, y, width, height }) {
  const margin = 0.02 * Math.max(width, height);
  return { x: x - margin, y: -y - height - margin, width: width + 2 * margin, height: height + 2 * margin };
}

// How far apart places usually are, in metres: the middle one of the lengths of connections.
function planUnit() {
  const lengths = state.account.connections.map(({ length }) => length).sort((one, other) => one - other);
  return lengths[lengths.length >> 1] ?? 5;
}

const flipped = points => points.map(([x, y]) => `${x} ${-y}`);

// An area is dragged by, too: what ends a movement of the picture chooses nothing.
function areaOf(region, number) {
  const d = [...region.outline, ...(region.holes ?? [])].map(ring => `M ${flipped(ring).join(" L ")} Z`).join(" ");
  const label = `${capital(regionTitle(number))}, ${region.kind}, ${region.area.toFixed(1)} m²`;
  return svg("path", { ...chooses("region", number, label), class: "area", d, "data-color": region.color }, svg("title", {}, label));
}

// A name stands at a place of the region, for the middle of a corridor that goes around something is not in it.
function areaName(region, number) {
  const place = state.account.places[region.places[0]];
  const [x, y] = place ? place.center : middleOf(region.outline[0]);
  return svg("text", { class: "area-name", "data-at": `${x} ${-y}`, y: -14, "aria-hidden": "true" }, regionTitle(number));
}

// The center of mass of a ring.
function middleOf(ring) {
  let [area, x, y] = [0, 0, 0];
  ring.forEach(([x1, y1], index) => {
    const [x2, y2] = ring[(index + 1) % ring.length];
    const cross = x1 * y2 - x2 * y1;
    area += cross;
    x += (x1 + x2) * cross;
    y += (y1 + y2) * cross;
  });
  return area ? [x / (3 * area), y / (3 * area)] : ring[0];
}

function walkOf(connection, number) {
  const points = flipped(connection.line).join(" ");
  const [from, to] = connection.ends;
  const label = `Connection ${number}: place ${from.place} by ${from.end} to place ${to.place} by ${to.end}, ${metres(connection.length)}`;
  return svg("g", { ...chooses("connection", number, label), class: "link walk" },
    svg("polyline", { points, class: "reach" }), svg("polyline", { points, class: "line" }), svg("title", {}, label));
}

function passageOf(passage, number) {
  const [[x1, y1], [x2, y2]] = passage.line;
  const ends = { x1, y1: -y1, x2, y2: -y2 };
  const label = `${capital(passageTitle(number))}, between ${passage.regions.map(regionTitle).join(" and ")}, ${passage.width.toFixed(2)} m wide, a door with ${likely(passage)}`;
  const names = ["passage", passage.kind === "door" ? "door" : "", passage.is_passable ? "" : "tight"].filter(Boolean).join(" ");
  return svg("g", { ...chooses("passage", number, label), class: names }, svg("line", { ...ends, class: "reach" }), svg("line", { ...ends, class: "line" }), svg("title", {}, label));
}

function spotOf(place, number) {
  const label = `Place ${number}, ${place.kind}${place.region === undefined ? "" : `, in ${regionTitle(place.region)}`}`;
  const [x, y] = place.center;
  return svg("g", { ...chooses("place", number, label), class: "place", "data-at": `${x} ${-y}` },
    svg("circle", { r: PLACE + 4, class: "halo" }), svg("circle", { r: PLACE }), svg("text", { y: 3.5, class: "number" }, String(number)), svg("title", {}, label));
}

function chooses(kind, number, label) {
  const click = () => !wasDragged() && choose({ kind, number });
  return { role: "button", tabindex: -1, "aria-label": label, [`data-${kind}`]: number, click, keydown: event => isPress(event) && choose({ kind, number }) };
}

// Marks what is chosen. Tab comes to one place only: that one, or the first.
function markPlan(picture) {
  const { chosen } = state;
  for (const kind of ["region", "passage", "place", "connection"]) {
    for (const node of picture.querySelectorAll(`[data-${kind}]`)) {
      const isChosen = chosen?.kind === kind && Number(node.getAttribute(`data-${kind}`)) === chosen.number;
      node.classList.toggle("chosen", isChosen);
      node.setAttribute("aria-pressed", String(isChosen));
    }
  }
  const stop = chosen?.kind === "place" ? chosen.number : 0;
  for (const place of picture.querySelectorAll(".place")) place.setAttribute("tabindex", Number(place.dataset.place) === stop ? 0 : -1);
  for (const area of picture.querySelectorAll(".area")) area.style.setProperty("--color", area.dataset.color);
}

