// Regions, passages, places and connections as lists to choose from.

function drawTables() {
  const { account } = state;
  return refill(byId("tables"),
    fold("regions", counted(account.regions.length, "region"), () => table(["region", "kind", "m²#", "m wide#", "passages#", "places"],
      account.regions.map((region, number) => [regionButton(number), region.kind, region.area.toFixed(1), region.width.toFixed(1), region.passages.length, listed(region.places.map(placeButton))]), "Regions")),
    fold("passages", counted(account.passages.length, "passage"), () => table(["passage", "from", "to", "m wide#", "door#", "robot"],
      account.passages.map((passage, number) => [passageButton(number), regionButton(passage.regions[0]), regionButton(passage.regions[1]), passage.width.toFixed(2), likely(passage), passage.is_passable ? "fits" : "too tight"]), "Passages")),
    fold("places", counted(account.places.length, "place"), () => table(["place", "kind", "region", "x, m#", "y, m#"],
      account.places.map((place, number) => [placeButton(number), place.kind, place.region === undefined ? "" : regionButton(place.region), place.center[0].toFixed(2), place.center[1].toFixed(2)]), "Places")),
    fold("connections", counted(account.connections.length, "connection"), () => table(["connection", "from", "by", "to", "by", "m#", "m wide#"],
      account.connections.map(({ ends: [from, to], length, width }, number) => [connectionButton(number), placeButton(from.place), from.end, placeButton(to.place), to.end, length.toFixed(1), width.toFixed(1)]), "Connections, to be driven in both directions")));
}

