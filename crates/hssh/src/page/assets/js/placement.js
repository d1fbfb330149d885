// Where the places of a map are drawn, and where their ends point.

// The places of a map of the ranking, as they come with it. Of a part of it, more places than there are.
const placedAsRanked = map => map.places;

// The places of a belief where the search laid them out then. Ends without a bearing point where the reference has them.
function placedAsBelieved(data, model, poses, reference) {
  const borrowed = placedAsKnown(data, model, reference);
  return model.places.map((place, number) => {
    const [x, y, theta] = poses[number] ?? [0, 0, 0];
    const bearings = data.stars[place.star].ends.map(end => end.bearing);
    const isMeasured = bearings.every(bearing => bearing !== undefined);
    return { x, y, directions: isMeasured ? bearings.map(bearing => theta + bearing) : borrowed[number].directions };
  });
}

// The places of any map where another one has their first visits. Two that it takes for one stand beside one another.
function placedAsKnown(data, model, reference) {
  const taken = new Map();
  let last = { x: 0, y: 0 };
  return model.places.map(place => {
    const degree = data.stars[place.star].ends.length;
    const known = reference.model.visits[place.first];
    const evenly = Array.from({ length: degree }, (_, end) => Math.PI / 2 - (2 * Math.PI * end) / degree);
    const there = known ? reference.places[known.place] : { x: last.x + reference.unit, y: last.y, directions: evenly };
    const before = known ? (taken.get(known.place) ?? 0) : 0;
    if (known) taken.set(known.place, before + 1);
    const rotation = known?.rotation ?? 0;
    const directions = evenly.map((even, end) => there.directions[(end + rotation) % degree] ?? even);
    const beside = 0.28 * before * reference.unit;
    last = { x: there.x + beside, y: there.y - beside };
    return { ...last, directions, double: before > 0 };
  });
}

// How long a typical link is.
function unitOf(model, places) {
  const lengths = model.links.map(({ ends: [one, other] }) => apart(places[one.place], places[other.place])).filter(length => length > 0);
  lengths.sort((one, other) => one - other);
  return lengths[Math.floor(lengths.length / 2)] ?? 1;
}

const apart = (one, other) => Math.hypot(one.x - other.x, one.y - other.y);

// The poses of every belief: each says only which places are new or have moved.
function posesOf(beliefs) {
  let poses = [];
  return beliefs.map(belief => {
    if (belief.moved?.length) {
      poses = poses.slice();
      for (const [number, ...pose] of belief.moved) poses[number] = pose;
    }
    return poses;
  });
}

// The branches of every belief.
function branchesOf(beliefs) {
  let words = [];
  return beliefs.map(belief => (words = words.slice(0, belief.kept).concat(belief.then ? belief.then.split(" ") : [])));
}

