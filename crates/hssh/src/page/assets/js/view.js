// What is looked at: a map of the ranking, a part of it, what was believed then, or a hypothesis of the tree.

// What the reader has chosen. `rank` of a map; `travel`, how many travels of it, or all; `then`, whether earlier travels show what was
// believed then; `node`, a hypothesis of the tree instead; `chosen`, a place, way or visit.
// `view` is what comes of all that; `robot`, of a page that is served, where the robot is now.
const state = { data: null, known: null, rank: 1, travel: Infinity, then: true, node: null, chosen: null, view: null, robot: null };

// What follows from the data alone, computed once.
function knowledge(data) {
  const ranked = new Map(data.maps.map(map => [map.rank, knownMap(data, map)]));
  const { beliefs } = data.history;
  return {
    ranked,
    reference: ranked.values().next().value ?? (data.reference && knownMap(data, data.reference)),
    branches: branchesOf(beliefs),
    poses: posesOf(beliefs),
    last: Math.max(data.maps.length ? data.input.explained : 0, beliefs.length - 1, 0),
  };
}

function knownMap(data, map) {
  const words = wordsOf(map.branch);
  const model = replay(data, words);
  return { map, words, model, places: map.places, unit: unitOf(model, map.places) };
}

const wordsOf = branch => (branch ? branch.split(" ") : []);

// The view that is chosen, or null if there is no map at all.
function viewOf({ data, known, rank, travel, then, node }) {
  const ranked = known.ranked.get(rank);
  const reference = ranked ?? known.reference;
  if (!reference) return null;
  if (node !== null && data.tree?.nodes[node]) return ofNode(data, reference, node);
  const upTo = Math.min(travel, known.last);
  if (upTo >= known.last && ranked) return whole(data, ranked);
  if (then || !ranked) {
    if (upTo < known.branches.length) return ofBelief(data, known, reference, upTo);
    if (!ranked) return whole(data, reference);
  }
  return part(data, ranked, upTo);
}

function whole(data, ranked) {
  return completed(data, { ...ranked, title: rankTitle(data, ranked.map), kind: "map", map: ranked.map });
}

function rankTitle(data, map) {
  const count = data.maps.length;
  if (!count) return `The best map of the first ${counted(wordsOf(map.branch).length, "travel")}: no map explains more.`;
  const listed = count > 1 ? `Map ${map.rank} of ${count} listed` : "The map";
  const probability = map.probability ? `, probability ${probable(map.probability)}` : "";
  const proved = map.optimal ? ", proved: none is better" : map.tied ? "" : ", not the best";
  const placed = map.measured ? "" : " Its drawing is a scheme: nothing was measured.";
  return `${listed}${probability}${proved}.${placed}`;
}

function part(data, ranked, upTo) {
  const words = ranked.words.slice(0, upTo);
  const title = `Map ${ranked.map.rank}, as far as its first ${counted(upTo, "travel")} show it: what is known today of that part, not what was believed then.`;
  return completed(data, { ...ranked, words, model: replay(data, words), title, kind: "part", map: ranked.map });
}

function ofBelief(data, known, reference, upTo) {
  const words = known.branches[upTo];
  const belief = data.history.beliefs[upTo];
  const model = replay(data, words);
  const poses = known.poses[upTo];
  const places = poses.length ? placedAsBelieved(data, model, poses, reference) : placedAsKnown(data, model, reference);
  const worth = [
    belief.tied > 1 ? `${belief.tied} maps were as good` : null,
    belief.probability ? `probability ${probable(belief.probability)}` : null,
    belief.proved ? "proved the best of the travels so far" : "not proved the best",
  ].filter(Boolean);
  const title = `What the on-line search believed after travel ${upTo} of ${data.input.considered}: ${worth.join(", ")}.`;
  return completed(data, { map: reference.map, words, model, places, unit: reference.unit, title, kind: "belief" });
}

function ofNode(data, reference, node) {
  const words = [];
  for (let at = node; data.tree.nodes[at].parent !== undefined; at = data.tree.nodes[at].parent) words.unshift(data.tree.nodes[at].follows);
  const model = replay(data, words);
  const places = placedAsKnown(data, model, reference);
  const { fate } = data.tree.nodes[node];
  const title = `Hypothesis ${node} of the tree: explains ${counted(words.length, "travel")}; ${FATES[fate]}. Places are drawn where map ${reference.map.rank} has them.`;
  return completed(data, { map: reference.map, words, model, places, unit: reference.unit, title, kind: "node" });
}

// What became of a hypothesis, in words.
const FATES = {
  open: "not looked at further",
  grown: "others follow from it",
  refuted: "the next travel refuted it",
  removed: "the axioms removed all that would follow",
  final: "it explains everything",
};

function completed(data, view) {
  return { ...view, ...pathsOf(data, view.model), robot: view.model.visits.length - 1 };
}

// What is chosen, as this view has it: visits are the same in all maps, places and ways are known by the first visit or travel.
function chosenIn(view, chosen) {
  if (!view || !chosen) return null;
  const { model } = view;
  if (chosen.kind === "way") {
    const link = model.links.find(link => link.travels.includes(chosen.travel));
    return link ? { kind: "way", link } : null;
  }
  const visit = model.visits[chosen.visit];
  return visit ? { kind: chosen.kind, place: visit.place, visit: chosen.visit } : null;
}

