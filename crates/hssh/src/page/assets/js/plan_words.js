// What the plan of a grid map is made of, in words: regions, passages, places and connections, each by its number.

// `data` of the page, `account` in it, and what is chosen: { kind, number }.
const state = { data: null, account: null, chosen: null };

const regionTitle = number => state.account.regions[number].name ?? `${state.account.regions[number].kind} ${number}`;
const passageTitle = number => `${state.account.passages[number].kind} ${number}`;
const likely = passage => `${Math.round(100 * passage.door_probability)} %`;

const regionButton = number => chosenBy("region", number, regionTitle(number));
const passageButton = number => chosenBy("passage", number, passageTitle(number));
const placeButton = number => chosenBy("place", number, `place ${number}`);
const connectionButton = number => chosenBy("connection", number, `connection ${number}`);

const chosenBy = (kind, number, words) => button(words, () => choose({ kind, number }), { class: "inline" });

// Several things with commas between them.
const listed = parts => parts.flatMap((part, index) => (index ? [", ", part] : [part]));

// How many there are of each kind, in the order in which they come: 6 rooms, 1 corridor.
function kindCounts(things) {
  const counts = new Map();
  for (const { kind } of things) counts.set(kind, (counts.get(kind) ?? 0) + 1);
  return [...counts].map(([kind, count]) => counted(count, kind)).join(", ");
}

// The ends of a star as pictures of stars take them.
const starOf = place => ({ name: place.star, ends: place.ends.map(end => ({ name: end.name, closed: !end.gateway, bearing: end.bearing })) });

// The connection that leaves a place by an end, and where it leads.
function leadingFrom(number, end) {
  const at = side => side.place === number && side.end === end;
  const found = state.account.connections.findIndex(({ ends }) => ends.some(at));
  if (found < 0) return null;
  const [one, other] = state.account.connections[found].ends;
  return { connection: found, to: at(one) ? other : one };
}

