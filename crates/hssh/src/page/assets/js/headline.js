// The answer in the first lines: how far it can be trusted, before anything else.

const VERDICTS = {
  one_best: ["good", "✓", "PROVED"],
  several_best: ["open", "≈", "SEVERAL"],
  unproved: ["open", "?", "NOT PROVED"],
  stopped_early: ["bad", "…", "STOPPED EARLY"],
  none_yet: ["bad", "…", "NO MAP YET"],
  no_closed_map: ["bad", "✕", "NO CLOSED MAP"],
  no_map: ["bad", "✕", "NO MAP"],
};

function drawHeadline() {
  const { data } = state;
  const [tone, sign, word] = VERDICTS[data.verdict.kind] ?? ["open", "?", data.verdict.kind];
  const best = data.maps[0];
  if (data.waiting && !best) return refill(byId("headline"), banner("open", "…", "WAITING", `${capital(data.waiting)}.`));
  refill(byId("headline"),
    data.waiting && banner("open", "…", "NOT NEW", `There is no newer map: ${data.waiting}.`),
    data.partial && banner("bad", "◐", "PARTIAL", capital(data.partial)),
    data.doubt && banner("bad", "!", "DOUBTFUL", capital(data.doubt)),
    banner(tone, sign, word, data.verdict.sentence),
    best?.probability && element("p", { class: "figure" }, element("strong", {}, probable(best.probability)), " is how probable the best map is",
      best.probability[0] < 0.99 * best.probability[1] ? ", as far as is known." : "."),
    element("div", { class: "trust" }, element("h2", {}, "Taken on trust"),
      element("ul", {}, data.certificate.trusted.map(one => element("li", { class: one.held ? null : "broken" }, one.held ? "" : element("strong", {}, "Contradicted: "), capital(one.sentence), ".")))),
    data.readings && element("div", { class: "trust" }, element("h2", {}, "Taken for misread"),
      data.readings.corrections.length ? element("ul", {}, data.readings.corrections.map(misreadLine)) : element("p", {}, "Nothing.")));
}

// Sentences count visits as told; the button finds the one that is meant.
function misreadLine({ sentence, visit: told, place }) {
  const { data, known } = state;
  const visit = data.visits.findIndex(one => one.told === told);
  const first = known.ranked.get(1)?.model.places[place]?.first;
  const chosen = visit >= 0 ? { kind: "visit", visit } : first !== undefined ? { kind: "place", visit: first } : null;
  return element("li", {}, capital(sentence), ". ", chosen && button("show", () => choose(chosen), { class: "inline", "aria-label": `Show: ${sentence}` }));
}

