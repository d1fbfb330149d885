// Places, ways and visits of what is shown, as lists to choose from.

function drawTables(view) {
  const node = byId("tables");
  byId("tables-card").hidden = !view;
  if (!view) return refill(node);
  const { model } = view;
  return refill(node,
    fold("places", counted(model.places.length, "place"), () => placeTable(view)),
    fold("ways", counted(model.links.length, "way"), () => wayTable(view)),
    fold("visits", counted(model.visits.length, "visit"), () => visitTable(view)));
}

function placeTable(view) {
  const { stars } = state.data;
  const isMeasured = view.map.measured && view.kind !== "node";
  const row = (place, number) => {
    const ends = stars[place.star].ends;
    const pending = ends.filter((end, index) => !end.closed && !view.model.linkOf.has(key(number, index)));
    const { x, y } = view.places[number];
    return [placeButton(view, number), stars[place.star].name, place.visits.length, pending.map(end => end.name).join(" "), ...(isMeasured ? [x.toFixed(2), y.toFixed(2)] : [])];
  };
  return table(["place", "star", "visits#", "pending", ...(isMeasured ? ["x, m#", "y, m#"] : [])], view.model.places.map(row), "Places, in the order in which they were found");
}

function wayTable(view) {
  const row = link => {
    const [from, to] = link.ends;
    return [wayButton(link), placeButton(view, from.place), endOnly(view, from), placeButton(view, to.place), endOnly(view, to), link.travels.length];
  };
  return table(["way", "from", "by", "to", "by", "travels#"], view.model.links.map(row), "Ways, in the order in which they were found");
}

function visitTable(view) {
  const { visits, stars } = state.data;
  const row = (visit, number) => [visitButton(number), placeButton(view, visit.place), stars[visits[number].star].name, findingWords(view, number)];
  return table(["visit", "place", "star seen", "how it follows"], view.model.visits.map(row), "Visits, the start first");
}

