// What the answer rests on: the input, what it warns of, and what the search did.

function drawBasis() {
  const { data } = state;
  const { input, search, warnings } = data;
  const facts = [
    ["input", `${input.name}, ${input.kind === "laser_log" ? "a robot's log" : "an exploration"}`],
    ["travels", `${input.explained} of ${input.considered} explained${input.considered < input.travels ? `, of ${input.travels} that there are` : ""}`],
    input.scans !== undefined && ["laser scans", `${input.scans}, of which ${input.scans_used} could be used`],
    input.evidence && ["returns", `${input.evidence.returns} shown by the laser, ${input.evidence.unconfirmed} more not confirmed, ${input.evidence.contradicted} contradicted; lost ${input.evidence.lost} times`],
    input.evidence && ["none of this misleads", `with a probability of ${percent(input.evidence.probability)}`],
    ["searched", `${search.order.replaceAll("_", " ")}, ${search.objective === "posterior" ? "by probability" : "by topology alone"}${search.closed_only ? ", closed maps only" : ""}; ${search.stop.replaceAll("_", " ")}`],
    ["hypotheses", `${search.nodes} made, ${search.refuted} refuted, ${search.found.maps} explain everything, ${search.found.closed} of these closed`],
    data.certificate.rest_probability !== undefined && ["maps not found", `probability of at most ${percent(data.certificate.rest_probability)} together`],
  ].filter(Boolean);
  refill(byId("basis"),
    element("dl", {}, facts.map(([name, value]) => [element("dt", {}, name), element("dd", {}, value)])),
    warnings.length > 0 && [element("h3", {}, "Warnings"), element("ul", { class: "warnings" }, warnings.map(warningLine))],
    fold("levels", "Hypotheses by travel", () => levelTable(search.levels)));
}

function warningLine({ sentence, count }) {
  return element("li", {}, capital(sentence), count > 1 ? ` (${count} times in all)` : "");
}

function levelTable(levels) {
  const most = Math.log1p(Math.max(...levels.map(level => level.nodes), 1));
  const bar = nodes => svg("svg", { viewBox: "0 0 100 10", class: "cost-bar", "aria-hidden": "true", preserveAspectRatio: "none" }, svg("rect", { width: (100 * Math.log1p(nodes)) / most, height: 10, class: "cost" }));
  return table(["travels", "hypotheses#", "", "refuted#"], levels.map(level => [level.travels, level.nodes, bar(level.nodes), level.refuted]), "Hypotheses that explain so many travels (bars: logarithm)");
}

