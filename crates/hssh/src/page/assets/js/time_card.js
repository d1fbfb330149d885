// Along the exploration: what is known after each travel.

function drawTime(view) {
  const { data, known } = state;
  const node = byId("time");
  if (!view || known.last === 0) return refill(node);
  const travel = Math.min(state.travel, known.last);
  const hadFocus = document.activeElement?.id === "travel";
  const slider = element("input", {
    type: "range", id: "travel", min: 0, max: known.last, step: 1, value: travel, "aria-valuetext": travelWords(travel),
    input: event => show({ travel: atEnd(Number(event.target.value)), node: null }),
  });
  slider.value = travel;
  refill(node,
    element("div", { class: "bar" }, element("label", { for: "travel" }, "Along the exploration"), element("output", { for: "travel" }, travelWords(travel)), modes()),
    slider, strip(view, travel), element("p", { class: "hint" }, modeWords()), changes());
  if (hadFocus) slider.focus();
}

const atEnd = travel => (travel >= state.known.last ? Infinity : travel);

const travelWords = travel => (travel === 0 ? "at the start" : `after travel ${travel} of ${state.data.input.considered}`);

function modes() {
  if (!state.known.ranked.size || !state.data.history.beliefs.length) return null;
  const mode = (then, words) => element("label", {}, element("input", {
    type: "radio", name: "mode", id: then ? "mode-then" : "mode-now", checked: state.then === then, change: () => show({ then }),
  }), ` ${words}`);
  return element("span", { class: "layers", role: "radiogroup", "aria-label": "What earlier travels show" }, mode(true, "as believed then"), mode(false, "as known now"));
}

function modeWords() {
  const { history, input } = state.data;
  if (!state.then || !history.beliefs.length) return "Earlier travels show the chosen map as far as it had been travelled: with hindsight, not what was believed then.";
  const log = input.kind === "laser_log" ? " It was told the visits and stars of the whole log's survey, which closed its loops with hindsight." : "";
  const end = history.end ? ` It ends early: ${history.end}${state.known.ranked.size ? "; later travels show the chosen map as known now" : ""}.` : "";
  return `Earlier travels show what the on-line search, told one travel after the other, took for the best map then.${log}${end}`;
}

// A mark for each travel: how it follows in the map shown, and where the belief changed.
function strip(view, travel) {
  const { known } = state;
  const at = number => (1000 * number) / known.last;
  const complete = (known.ranked.get(state.rank) ?? known.reference).model.visits;
  const wide = Math.min(1000 / known.last, 24);
  const mark = complete.map((visit, number) => svg("rect", {
    x: at(number) - wide * 0.4, y: 2, width: wide * 0.8, height: 8, class: `finding-${visit.finding}`, click: () => show({ travel: atEnd(number), node: null }),
  }));
  const turns = changesOfMind().map(number => svg("path", { d: `M ${at(number)} 12 l 5 8 h -10 Z`, class: "change" }));
  const marks = svg("svg", { viewBox: "-12 0 1024 22", class: "strip", "aria-hidden": "true", preserveAspectRatio: "none" },
    mark, turns, svg("line", { x1: at(travel), x2: at(travel), y1: 0, y2: 22, class: "now" }));
  const key = (name, words) => element("span", {}, svg("svg", { viewBox: "0 0 12 12", class: "sample" }, svg("rect", { width: 12, height: 12, class: name })), ` ${words}`);
  return [marks, element("div", { class: "legend", "aria-hidden": "true" }, key("finding-new_place", "new place"), key("finding-closure", "back at a known place"),
    key("finding-predicted", "as predicted"), turns.length > 0 && element("span", {}, svg("svg", { viewBox: "0 0 12 12", class: "sample" }, svg("path", { d: "M 6 0 l 6 12 h -12 Z", class: "change" })), " the belief changed"))];
}

// After which travels something was believed of earlier ones that was not believed before.
function changesOfMind() {
  const { branches } = state.known;
  return branches.map((_, travel) => travel).filter(travel => travel > 0 && state.data.history.beliefs[travel].kept < branches[travel - 1].length);
}

function changes() {
  const turns = changesOfMind();
  if (!turns.length) return null;
  const what = travel => button(`travel ${travel}`, () => show({ travel: atEnd(travel), then: true, node: null }), { class: "inline" });
  const shown = turns.slice(0, 12);
  return element("p", { class: "changes" }, "It changed its mind about earlier travels after ", shown.map((travel, index) => [index ? ", " : "", what(travel)]),
    turns.length > shown.length ? `, and ${turns.length - shown.length} more times.` : ".");
}

