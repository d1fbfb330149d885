// The page of a grid map: data in, everything drawn.

function drawAll() {
  const { account } = state;
  document.title = `${account.name} – hssh`;
  byId("name").textContent = account.name;
  const doors = account.passages.filter(passage => passage.kind === "door").length;
  const { width, height, resolution } = account.grid;
  refill(byId("headline"),
    account.doubt && banner("bad", "!", "DOUBTFUL", capital(account.doubt)),
    account.places.length === 0 && banner("bad", "✕", "NO PLACE", "Nowhere are there ways out."),
    element("p", { class: "figure" }, element("strong", {}, kindCounts(account.regions) || "No region"), `; ${counted(account.passages.length, "passage")}, ${doors} of them with a door; ${counted(account.places.length, "place")}, ${counted(account.connections.length, "connection")}.`),
    element("p", { class: "hint" }, `${width} × ${height} cells of ${resolution} m`, account.roadmap && `; ways for a robot with a radius of ${account.roadmap.radius} m`));
  refill(byId("map-layers"), switches());
  refill(byId("map-zoom"), zoomButtons(byId("map-picture"), planUnit()));
  refill(byId("map-legend"), legend());
  drawPlan(byId("map-picture"));
  drawDetail();
  drawTables();
}

function switches() {
  const words = { grid: "building", regions: "regions", ways: "ways", names: "names of regions" };
  return Object.keys(words).map(layer => element("label", {},
    element("input", { type: "checkbox", id: `layer-${layer}`, checked: layers[layer], change: event => { layers[layer] = event.target.checked; drawPlan(byId("map-picture")); } }),
    ` ${words[layer]}`));
}

function legend() {
  const line = (name, words) => element("span", {}, svg("svg", { viewBox: "0 0 24 12", class: "sample" }, name), ` ${words}`);
  const stroke = name => svg("line", { x1: 1, y1: 6, x2: 23, y2: 6, class: name });
  return [
    line(svg("circle", { cx: 12, cy: 6, r: 5, class: "place-sample" }), "place"),
    line(stroke("walk-sample"), "way"),
    line(stroke("door-sample"), "passage with a door, more probably than not"),
    line(stroke("opening-sample"), "passage without; gray: too tight for the robot"),
  ];
}

// Chooses a region, a passage, a place or a connection, or nothing.
function choose(chosen) {
  state.chosen = chosen;
  markPlan(byId("map-picture"));
  drawDetail();
}

function onKey(event) {
  const number = event.target.closest?.("[data-place]")?.dataset.place;
  goByKey(event, byId("map-picture"), planUnit(), {
    points: state.account.places.map(({ center: [x, y] }) => ({ x, y })), at: number === undefined ? null : Number(number),
    to: next => choose({ kind: "place", number: next }), none: () => choose(null),
  });
}

const data = JSON.parse(byId("data").textContent);
if (data.format !== "hssh-plan" || data.version !== 1) throw new Error(`this page draws hssh-plan data of version 1, not ${data.format} ${data.version}`);
Object.assign(state, { data, account: data.account });
startTheme();
watchPointer(byId("map-picture"), planUnit, () => drawPlan(byId("map-picture")));
byId("map-picture").addEventListener("keydown", onKey);
drawAll();
window.hssh = { state, layers };
