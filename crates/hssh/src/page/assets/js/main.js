// The page: data in, everything drawn; drawn again when something else is chosen or there are other data.

// Draws the page of other data. What is chosen stays chosen, as far as it is still there.
function renderData(data) {
  if (data.format !== "hssh-page" || data.version !== 1) throw new Error(`this page draws hssh-page data of version 1, not ${data.format} ${data.version}`);
  const isFirst = state.data === null;
  Object.assign(state, { data, known: knowledge(data) });
  if (isFirst || !state.known.ranked.has(state.rank)) state.rank = isFirst ? data.shown : (data.maps[0]?.rank ?? 1);
  if (state.node !== null && !data.tree?.nodes[state.node]) state.node = null;
  document.title = `${data.input.name} – hssh`;
  byId("name").textContent = data.input.name;
  drawHeadline();
  drawBasis();
  render();
  listen(data.live);
}

// Draws what depends on what is chosen.
function render() {
  const view = viewOf(state);
  state.view = view;
  drawMapCard(view);
  drawDetail(view);
  drawTime(view);
  drawRanking();
  drawCosts();
  drawTree();
  drawTables(view);
}

// Looks at something else.
function show(change) {
  Object.assign(state, change);
  render();
}

// Chooses a place, a way or a visit, or nothing: what is drawn stays, and is marked.
function choose(chosen) {
  state.chosen = chosen;
  markMap(byId("map-picture"), chosenIn(state.view, chosen));
  drawDetail(state.view);
}

startTheme();
watchPointer(byId("map-picture"), () => state.view.unit, () => drawMapCard(state.view));
renderData(JSON.parse(byId("data").textContent));
window.hssh = { render: renderData, state, replay, wordsOf };
