// A map from its branch: the exploration followed word by word, as docs/answer-format.md says what the words mean.

// Which end of the place an end of the star seen lies on.
const turned = (end, rotation, degree) => (end + rotation) % degree;

const key = (place, end) => `${place}/${end}`;

// Places, links and visits of the first travels, as many as there are words.
function replay(data, words) {
  const model = { places: [], links: [], visits: [], linkOf: new Map(), starts: [] };
  addPlace(model, data, 0);
  model.visits.push({ place: 0, rotation: 0, finding: "start" });
  words.forEach((word, travel) => follow(model, data, word, travel));
  model.visits.forEach((visit, number) => model.places[visit.place].visits.push(number));
  return model;
}

// The place of a visit that is the first to it. Ends are numbered place by place: `starts` has the first number of each.
function addPlace(model, data, visit) {
  const star = data.visits[visit].star;
  const last = model.places.length - 1;
  model.starts.push(last < 0 ? 0 : model.starts[last] + data.stars[model.places[last].star].ends.length);
  model.places.push({ star, first: visit, visits: [] });
}

function follow(model, data, word, travel) {
  const before = model.visits[travel];
  const seen = data.visits[travel + 1];
  const degree = data.stars[seen.star].ends.length;
  const exit = turned(data.visits[travel].exit, before.rotation, data.stars[model.places[before.place].star].ends.length);
  let place, end;
  if (word === "n") {
    addPlace(model, data, travel + 1);
    [place, end] = [model.places.length - 1, seen.entry];
  } else if (word === "p") {
    const link = model.linkOf.get(key(before.place, exit));
    const other = link.ends[0].place === before.place && link.ends[0].end === exit ? link.ends[1] : link.ends[0];
    [place, end] = [other.place, other.end];
  } else {
    const number = Number(word.slice(1));
    place = model.starts.findLastIndex(start => start <= number);
    end = number - model.starts[place];
  }
  travelled(model, { place: before.place, end: exit }, { place, end }, travel);
  before.exit = exit;
  const finding = { n: "new_place", p: "predicted" }[word] ?? "closure";
  model.visits.push({ place, rotation: (end - seen.entry + degree) % degree, finding, entry: end });
}

function travelled(model, from, to, travel) {
  let link = model.linkOf.get(key(from.place, from.end));
  if (!link) {
    link = { number: model.links.length, ends: [from, to], travels: [] };
    model.links.push(link);
    model.linkOf.set(key(from.place, from.end), link).set(key(to.place, to.end), link);
  }
  link.travels.push(travel);
}

// The other end of an end's link.
function beyond(link, place, end) {
  const [one, other] = link.ends;
  return one.place === place && one.end === end ? other : one;
}

