// The tree of hypotheses: from left to right one travel after the other, each hypothesis as a mark for what became of it.

const STEP = 22;
const ROW = 15;

function drawTree() {
  const { tree } = state.data;
  const node = byId("tree");
  byId("tree-card").hidden = !tree;
  if (!tree) return refill(node);
  const drawn = byId("tree-picture");
  // Nothing but marks changes with what is chosen: a large tree is not drawn again, and keeps its focus.
  if (drawn?.of === tree) return markTree(drawn);
  const { at, children, rows } = arranged(tree.nodes);
  const [width, height] = [STEP * (Math.max(...at.map(point => point.column)) + 3), ROW * (rows + 1)];
  const picture = svg("svg", { id: "tree-picture", width, height, viewBox: `0 0 ${width} ${height}`, role: "tree", "aria-label": "Hypotheses: arrow keys go to parent, child and siblings" },
    svg("rect", { class: "column", y: 0, width: STEP, height }),
    tree.nodes.map((one, number) => one.parent !== undefined && edge(at[one.parent], at[number], one)),
    tree.nodes.map((one, number) => mark(one, at[number], number)));
  Object.assign(picture, { of: tree, onkeydown: event => walkTree(event, tree.nodes, children) });
  const frame = element("div", { class: "scroll" }, picture);
  refill(node, element("p", { class: "hint" }, treeWords(tree)), treeLegend(), frame);
  frame.scrollTop = at[0].y - frame.clientHeight / 2;
  markTree(picture);
}

function treeWords({ nodes, made }) {
  const all = nodes.length < made
    ? `${nodes.length} of ${made} hypotheses: first those on the way to the listed maps, then what branches off; a number says how many below are not shown.`
    : made === 1 ? "The only hypothesis." : `All ${made} hypotheses.`;
  return `${all} One column, one travel. Choose one to see its map.`;
}

// Where each hypothesis is drawn: leaves below one another, parents in the middle of their children.
function arranged(nodes) {
  const children = nodes.map(() => []);
  nodes.forEach(({ parent }, number) => parent !== undefined && children[parent].push(number));
  const column = [];
  nodes.forEach(({ parent }, number) => { column[number] = parent === undefined ? 0 : column[parent] + 1; });
  const row = [];
  let rows = 0;
  const waiting = [0];
  while (waiting.length) {
    const number = waiting.at(-1);
    const next = children[number].find(child => row[child] === undefined);
    if (next !== undefined) waiting.push(next);
    else {
      const own = children[number];
      row[number] = own.length ? (row[own[0]] + row[own.at(-1)]) / 2 : rows++;
      waiting.pop();
    }
  }
  return { at: nodes.map((_, number) => ({ column: column[number], x: STEP * (column[number] + 0.5), y: ROW * (row[number] + 1) })), children, rows };
}

function edge(from, to, { follows }) {
  const kind = follows === "p" ? "predicted" : follows === "n" ? "new" : "closure";
  return svg("path", { d: `M ${from.x} ${from.y} C ${from.x + STEP / 2} ${from.y} ${to.x - STEP / 2} ${to.y} ${to.x} ${to.y}`, class: `edge ${kind}` });
}

const MARKS = {
  grown: () => svg("circle", { r: 3.5 }),
  open: () => svg("circle", { r: 3.5, class: "hollow" }),
  refuted: () => svg("path", { d: "M -4 -4 L 4 4 M 4 -4 L -4 4", class: "cross" }),
  removed: () => svg("path", { d: "M 0 -4.5 L 4.5 4 L -4.5 4 Z", class: "hollow" }),
  final: () => svg("rect", { x: -4.5, y: -4.5, width: 9, height: 9 }),
};

function mark(node, { x, y, column }, number) {
  const follows = node.follows === "n" ? "a new place" : node.follows === "p" ? "as predicted" : node.follows ? "back at a known place" : "the start";
  const rank = node.rank ? `map ${node.rank} of the ranking, ` : "";
  const below = node.hidden ? `, ${node.hidden} below not shown` : "";
  const label = `Hypothesis ${number}, ${rank}${counted(column, "travel")}, ${follows}; ${FATES[node.fate]}${below}`;
  const click = () => show({ node: number });
  return svg("g", {
    class: `node ${node.fate}${node.rank ? " ranked" : ""}`, transform: `translate(${x} ${y})`, role: "treeitem", tabindex: number === 0 ? 0 : -1,
    "aria-label": label, "aria-level": column + 1, "data-node": number, click, keydown: event => isPress(event) && click(),
  }, svg("circle", { r: 8, class: "reach" }), MARKS[node.fate](),
    node.rank ? svg("text", { x: 9, y: 4 }, `map ${node.rank}`) : node.hidden ? svg("text", { x: 7, y: 4, class: "below" }, `+${node.hidden}`) : null, svg("title", {}, label));
}

// Marks the hypothesis that is shown and the travel of the slider.
function markTree(picture) {
  for (const one of picture.querySelectorAll(".node.chosen")) {
    one.classList.remove("chosen");
    one.removeAttribute("aria-selected");
  }
  const chosen = state.node === null ? null : picture.querySelector(`[data-node="${state.node}"]`);
  chosen?.classList.add("chosen");
  chosen?.setAttribute("aria-selected", "true");
  picture.querySelector(".column").setAttribute("x", STEP * Math.min(state.travel, state.known.last));
}

function walkTree(event, nodes, children) {
  const number = Number(event.target.closest("[data-node]")?.dataset.node ?? 0);
  const siblings = nodes[number].parent === undefined ? [number] : children[nodes[number].parent];
  const beside = step => siblings[siblings.indexOf(number) + step];
  const next = { ArrowLeft: nodes[number].parent, ArrowRight: children[number][0], ArrowUp: beside(-1), ArrowDown: beside(1), Home: 0 }[event.key];
  if (next === undefined) return;
  event.preventDefault();
  const picture = byId("tree-picture");
  const to = picture.querySelector(`[data-node="${next}"]`);
  picture.querySelector(".node[tabindex='0']")?.setAttribute("tabindex", -1);
  to.setAttribute("tabindex", 0);
  to.focus();
}

function treeLegend() {
  const item = (fate, words) => element("span", { class: "tree-sample" }, svg("svg", { viewBox: "-8 -8 16 16", class: "sample" }, svg("g", { class: `node ${fate}` }, MARKS[fate]())), ` ${words}`);
  const line = (kind, words) => element("span", {}, svg("svg", { viewBox: "0 0 24 12", class: "sample" }, svg("path", { d: "M 1 6 H 23", class: `edge ${kind}` })), ` ${words}`);
  return element("div", { class: "legend", "aria-hidden": "true" }, Object.entries(FATES).map(([fate, words]) => item(fate, words)),
    line("new", "a new place"), line("predicted", "as predicted"), line("closure", "back at a known place"));
}

