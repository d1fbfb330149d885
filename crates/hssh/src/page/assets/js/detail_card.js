// What is chosen: a place with its visits, a way with its travels, or a visit with what was seen.

const NOTHING = "Choose a place or a way of the map: by mouse, or with Tab and the arrow keys.";

function drawDetail(view) {
  const node = byId("detail");
  const chosen = chosenIn(view, state.chosen);
  if (!view) return refill(node);
  if (state.chosen && !chosen) return refill(node, element("p", {}, goneWords(state.chosen)), clearButton());
  if (!chosen) return refill(node, element("p", { class: "hint" }, NOTHING));
  const make = { place: placeDetail, way: wayDetail, visit: visitDetail }[chosen.kind];
  return refill(node, make(view, chosen), clearButton());
}

const goneWords = chosen => (chosen.kind === "way" ? `The way of travel ${chosen.travel + 1}` : `The place of visit ${chosen.visit}`) + " is not part of what is shown.";

const clearButton = () => button("Choose nothing", () => choose(null), { class: "quiet", id: "clear" });

function placeDetail(view, { place: number }) {
  const { data } = state;
  const place = view.model.places[number];
  const star = data.stars[place.star];
  const { x, y, double } = view.places[number];
  const where = view.map.measured ? ` at (${x.toFixed(1)}, ${y.toFixed(1)}) m` : "";
  return [
    element("h3", {}, `Place ${number}`),
    element("p", {}, `Star “${star.name}”${where}, found on visit ${place.first}, ${counted(place.visits.length, "visit")}.`),
    double && element("p", { class: "note" }, "The map it is drawn by takes it for the same place as the one beside it."),
    starPicture(star),
    misreadOf(number, null),
    element("h4", {}, "Ends, clockwise"),
    element("ul", { class: "plain" }, star.ends.map((end, index) => element("li", {}, endLine(view, number, index, end)))),
    element("h4", {}, "Visits"),
    element("ul", { class: "plain" }, place.visits.map(visit => element("li", {}, visitButton(visit), ` ${findingWords(view, visit)}`))),
    place.visits.filter(visit => data.visits[visit].picture).map(visit => localFigure(visit)),
  ];
}

function endLine(view, number, index, end) {
  const link = view.model.linkOf.get(key(number, index));
  const label = end.label ? ` (${end.label})` : "";
  if (!link) return `${end.name}${label}: ${end.closed ? "closed" : "pending, never travelled"}`;
  const other = beyond(link, number, index);
  return [`${end.name}${label}: `, wayButton(link), " to ", placeButton(view, other.place)];
}

const placeButton = (view, number) => button(`place ${number}`, () => choose({ kind: "place", visit: view.model.places[number].first }), { class: "inline" });
const wayButton = link => button(`way ${link.number}`, () => choose({ kind: "way", travel: link.travels[0] }), { class: "inline" });
const visitButton = visit => button(`visit ${visit}`, () => choose({ kind: "visit", visit }), { class: "inline" });

function findingWords(view, number) {
  const visit = view.model.visits[number];
  const turned = visit.rotation ? `, its star turned by ${counted(visit.rotation, "end")}` : "";
  return { start: "the start", new_place: "a new place", predicted: "as predicted", closure: "back, by a gateway that was pending" }[visit.finding] + turned;
}

function wayDetail(view, { link }) {
  const [one, other] = link.ends;
  const path = view.paths[view.pathOf.get(key(one.place, one.end))];
  const length = view.map.measured ? `, ${metres(apart(view.places[one.place], view.places[other.place]))} from place to place` : "";
  const along = path.places.map(place => place).join(" – ") + (path.circular ? " – and around" : "");
  return [
    element("h3", {}, `Way ${link.number}`),
    element("p", {}, "From ", placeButton(view, one.place), ` (${endOnly(view, one)}) to `, placeButton(view, other.place), ` (${endOnly(view, other)})${length}.`),
    element("p", {}, `On the path through the places ${along}.`),
    element("h4", {}, "Travels"),
    element("ul", { class: "plain" }, link.travels.map(travel => element("li", {}, `travel ${travel + 1}, to `, visitButton(travel + 1), ` ${findingWords(view, travel + 1)}`))),
  ];
}

const endOnly = (view, { place, end }) => state.data.stars[view.model.places[place].star].ends[end].name;

function visitDetail(view, { visit: number, place }) {
  const { data } = state;
  const visit = data.visits[number];
  const star = data.stars[visit.star];
  const start = data.visits[0].times?.[0];
  const facts = [
    visit.told !== undefined && visit.told !== number ? `visit ${visit.told} as told` : null,
    data.readings && visit.told === undefined ? "not reported: passed unnoticed" : null,
    visit.scan !== undefined ? `scan ${visit.scan + 1}, in sight of it from scan ${visit.scans[0] + 1} to ${visit.scans[1] + 1}` : null,
    visit.times ? `${clock(visit.times[0] - start)} to ${clock(visit.times[1] - start)} min after the start` : null,
  ].filter(Boolean);
  return [
    element("h3", {}, `Visit ${number}`),
    element("p", {}, "To ", placeButton(view, place), `: ${findingWords(view, number)}.`),
    number === 0 && element("p", {}, "Visits count from 0, the start, as --same and --different count them."),
    facts.length > 0 && element("p", {}, `${capital(facts.join("; "))}.`),
    element("p", {}, `Star “${star.name}”, as seen:`),
    starPicture(star, visit.entry, visit.exit),
    misreadOf(null, visit.told),
    visit.picture && localFigure(number),
    element("p", {}, button("Show the map so far", () => show({ travel: number, node: null }), { id: "so-far" })),
  ];
}

function localFigure(number) {
  const { picture, star } = state.data.visits[number];
  const label = `Local map of visit ${number}, with the star's gateways`;
  return element("figure", {}, localMap(picture, state.data.stars[star], label), element("figcaption", {}, label));
}

// What was taken for misread at a place, or on a visit as told.
function misreadOf(place, told) {
  const found = (state.data.readings?.corrections ?? []).filter(one => (place !== null ? one.place === place : one.visit === told));
  if (!found.length) return null;
  return element("div", { class: "note" }, element("h4", {}, "Taken for misread"), element("ul", {}, found.map(one => element("li", {}, capital(one.sentence), "."))));
}

