// What is chosen on the plan: a region, a passage, a place or a connection.

const NOTHING = "Choose a room, a door, a place or a way of the plan: by mouse, or with Tab and the arrow keys.";

function drawDetail() {
  const node = byId("detail");
  const { chosen } = state;
  if (!chosen) return refill(node, element("p", { class: "hint" }, NOTHING));
  const make = { region: regionDetail, passage: passageDetail, place: spotDetail, connection: walkDetail }[chosen.kind];
  return refill(node, make(chosen.number), button("Choose nothing", () => choose(null), { class: "quiet", id: "clear" }));
}

function regionDetail(number) {
  const { account } = state;
  const region = account.regions[number];
  return [
    element("h3", {}, capital(regionTitle(number))),
    element("p", {}, `${region.name ? `A ${region.kind}, region ${number}: ` : ""}${region.area.toFixed(1)} m², about ${region.width.toFixed(1)} m wide.`),
    element("h4", {}, "Leads to"),
    region.passages.length ? element("ul", { class: "plain" }, region.passages.map(passage => beyondLine(number, passage))) : element("p", {}, "Nothing leads out."),
    region.places.length > 0 && element("h4", {}, "Places"),
    element("p", {}, listed(region.places.map(placeButton))),
  ];
}

function beyondLine(number, index) {
  const passage = state.account.passages[index];
  const [one, other] = passage.regions;
  return element("li", {}, regionButton(one === number ? other : one), " by ", passageButton(index), `, ${passage.width.toFixed(2)} m wide, a door with ${likely(passage)}${tightWords(passage)}`);
}

const tightWords = passage => (passage.is_passable ? "" : ", too tight for the robot");

function passageDetail(number) {
  const passage = state.account.passages[number];
  const [x, y] = passage.position;
  return [
    element("h3", {}, capital(passageTitle(number))),
    element("p", {}, "Between ", regionButton(passage.regions[0]), " and ", regionButton(passage.regions[1]), `, at (${x.toFixed(1)}, ${y.toFixed(1)}) m, ${passage.width.toFixed(2)} m wide${tightWords(passage)}.`),
    element("p", {}, `It has a door with a probability of ${likely(passage)}.`),
  ];
}

function spotDetail(number) {
  const place = state.account.places[number];
  const [x, y] = place.center;
  const star = starOf(place);
  return [
    element("h3", {}, `Place ${number}`),
    element("p", {}, `A ${place.kind} at (${x.toFixed(1)}, ${y.toFixed(1)}) m`, place.region !== undefined && [" in ", regionButton(place.region)], place.clearance !== undefined && `, ${place.clearance.toFixed(1)} m from the nearest obstacle`, "."),
    star.ends.length > 0 && starPicture(star),
    element("h4", {}, "Ends, clockwise"),
    element("ul", { class: "plain" }, place.ends.map(end => element("li", {}, endLine(number, end)))),
  ];
}

function endLine(number, end) {
  if (!end.gateway) return `${end.name}: closed`;
  const lead = leadingFrom(number, end.name);
  const where = `${end.name}, ${end.gateway.width.toFixed(1)} m wide`;
  return lead ? [`${where}: `, connectionButton(lead.connection), " to ", placeButton(lead.to.place)] : `${where}: leads to no other place`;
}

function walkDetail(number) {
  const { ends: [from, to], length, width, passages } = state.account.connections[number];
  return [
    element("h3", {}, `Connection ${number}`),
    element("p", {}, "From ", placeButton(from.place), ` (${from.end}) to `, placeButton(to.place), ` (${to.end}), ${metres(length)}, ${width.toFixed(1)} m wide where it is narrowest.`),
    passages?.length > 0 && element("p", {}, "Through ", listed(passages.map(passageButton)), "."),
  ];
}

