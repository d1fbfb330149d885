// Numbers and counts as people read them.

const counted = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;

const degrees = radians => `${Math.round((radians * 180) / Math.PI)}°`;

const metres = length => `${length.toFixed(length < 10 ? 1 : 0)} m`;

function percent(probability) {
  if (probability <= 0) return "0 %";
  if (probability < 0.0001) return `${probability.toExponential(0)}`;
  if (probability > 0.9999 && probability < 1) return "> 99.99 %";
  return `${+(100 * probability).toPrecision(probability > 0.99 ? 4 : 2)} %`;
}

// A probability that is only bounded must not read like one that is known.
function probable([least, most]) {
  if (least >= 0.99 * most) return percent(most);
  return least < 1e-6 ? `at most ${percent(most)}` : `${percent(least)} to ${percent(most)}`;
}

function clock(seconds) {
  const whole = Math.round(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

const capital = text => text.charAt(0).toUpperCase() + text.slice(1);

