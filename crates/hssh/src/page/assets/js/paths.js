// The paths of a map: places joined by going straight on.

// The number of the end that continues an end, by end of a star.
function opposites(star) {
  const other = name => name.slice(0, -1) + (name.endsWith("+") ? "-" : "+");
  return star.ends.map(end => star.ends.findIndex(one => one.name === other(end.name)));
}

// All paths, and by end of a place the number of the path it is on. Paths with more than one place come first, in the order in which their
// first places were found.
function pathsOf(data, model) {
  const across = data.stars.map(opposites);
  const seen = new Set();
  const paths = [];
  model.places.forEach((place, number) => data.stars[place.star].ends.forEach((_, end) => {
    if (!seen.has(key(number, end))) paths.push(course(model, across, seen, { place: number, end }));
  }));
  const isLong = path => path.places.length > 1 || path.circular;
  paths.sort((one, other) => isLong(other) - isLong(one));
  const pathOf = new Map();
  paths.forEach((path, number) => path.ends.forEach(({ place, end }) => pathOf.set(key(place, end), number)));
  return { paths, pathOf };
}

// The path through an end: on through this end as far as it goes, and then back through all of it.
function course(model, across, seen, from) {
  const over = ({ place, end }) => ({ place, end: across[model.places[place].star][end] });
  const next = at => {
    const link = model.linkOf.get(key(at.place, at.end));
    return link && over(beyond(link, at.place, at.end));
  };
  let last = from;
  let circular = false;
  for (let at = next(from); at; at = next(at)) {
    if (at.place === from.place && at.end === from.end) {
      circular = true;
      break;
    }
    last = at;
  }
  const path = { places: [], ends: [], circular };
  for (let at = circular ? from : over(last); at && !seen.has(key(at.place, at.end)); at = next(at)) {
    path.places.push(at.place);
    for (const end of [at, over(at)]) {
      path.ends.push(end);
      seen.add(key(end.place, end.end));
    }
  }
  return path;
}

