// The ranked maps, what tells them from the first, and what the chosen one costs.

function drawRanking() {
  const { data } = state;
  const node = byId("ranking");
  if (!data.maps.length) return refill(node, element("p", {}, data.waiting ? "There is no map yet." : "No map explains everything considered."));
  const isPosterior = data.search.objective === "posterior";
  const columns = ["map", ...(isPosterior ? ["probability#", "cost, nats#"] : []), "undetermined#", "paths#", "places#", "genus#", "closed"];
  const focused = document.activeElement?.id;
  refill(node, table(columns, data.maps.map(map => rankRow(map, isPosterior)), "The maps, the best first"), unlisted(), differenceOf());
  if (focused?.startsWith("rank-")) byId(focused)?.focus();
}

function rankRow(map, isPosterior) {
  const { undetermined_boundaries: undetermined, paths, places, genus } = map.measure;
  const mark = map.optimal ? "proved best" : map.tied && map.rank > 1 ? "as good as the first" : null;
  const isShown = map.rank === state.rank;
  const pick = button(`map ${map.rank}`, () => show({ rank: map.rank, travel: Infinity, node: null }), { id: `rank-${map.rank}`, "aria-pressed": String(isShown) });
  return {
    attributes: { class: isShown ? "chosen" : null },
    cells: [[pick, mark && element("span", { class: "mark" }, ` ${mark}`)],
      ...(isPosterior ? [map.probability && probable(map.probability), map.costs?.total.toFixed(3)] : []),
      undetermined, paths, places, genus, map.closed ? "yes" : "no"],
  };
}

function unlisted() {
  const more = state.data.search.found.maps - state.data.maps.length;
  return more > 0 ? element("p", { class: "hint" }, `… and ${counted(more, "more map")}, not listed.`) : null;
}

function differenceOf() {
  const map = state.data.maps.find(one => one.rank === state.rank);
  if (!map || map.rank === 1 || !map.difference) return null;
  const { sentence, parting } = map.difference;
  return element("div", { class: "note", id: "difference" },
    element("p", {}, element("strong", {}, `What tells map ${map.rank} from map 1: `), capital(sentence)),
    parting && element("p", {}, button(`Show visit ${parting.visit}, where they part`, () => choose({ kind: "visit", visit: parting.visit }), { id: "parting" })));
}

const COSTS = {
  bend: "how far measured travels contradict one another in the best layout of the places: χ²/2",
  vagueness: "how vaguely the layout so far predicts travels between known places",
  places: "travels to new places: how likely a corridor leads there",
  choices: "how many ways to go on there were at each choice",
  complexity: "how complex the map is",
  appearance: "how little the local maps of visits to one place look alike",
};

function drawCosts() {
  const { data } = state;
  const map = data.maps.find(one => one.rank === state.rank);
  const first = data.maps[0];
  byId("cost-card").hidden = !map?.costs;
  if (!map?.costs) return refill(byId("costs"));
  const isFirst = map === first;
  const largest = Math.max(...[map, first].flatMap(one => one.costs.items.map(item => Math.abs(item.nats))), 1e-9);
  const ofFirst = name => first.costs.items.find(item => item.item === name)?.nats ?? 0;
  const bar = nats => svg("svg", { viewBox: "0 0 100 10", class: "cost-bar", "aria-hidden": "true", preserveAspectRatio: "none" },
    svg("rect", { width: (100 * Math.abs(nats)) / largest, height: 10, class: nats < 0 ? "gain" : "cost" }));
  const rows = map.costs.items.filter(({ item, nats }) => nats !== 0 || ofFirst(item) !== 0).map(({ item, nats }) => [
    element("span", {}, element("strong", {}, item), element("span", { class: "hint" }, ` ${COSTS[item] ?? ""}`)), nats.toFixed(3), bar(nats),
    ...(isFirst ? [] : [signed(nats - ofFirst(item))]),
  ]);
  rows.push([element("strong", {}, "together"), map.costs.total.toFixed(3), "", ...(isFirst ? [] : [signed(map.costs.total - first.costs.total)])]);
  refill(byId("costs"),
    table(["item", "nats#", "", ...(isFirst ? [] : ["more than map 1#"])], rows, `Map ${map.rank}, by item`),
    element("p", { class: "hint" }, "Nats: minus the logarithm of the probability, up to a constant that all maps share; one that costs 1 nat more is e = 2.7 times less probable."));
}

const signed = number => (number >= 0 ? "+" : "−") + Math.abs(number).toFixed(3);

