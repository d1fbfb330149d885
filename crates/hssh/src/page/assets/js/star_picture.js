// A star as it was seen, drawn for itself.

// Directions of ends whose bearings are not known: evenly, clockwise from the top.
function directionsOf(star) {
  const evenly = (_, end) => Math.PI / 2 - (2 * Math.PI * end) / star.ends.length;
  return star.ends.every(end => end.bearing !== undefined) ? star.ends.map(end => end.bearing) : star.ends.map(evenly);
}

// The star with the ends named, and marks at the ends that the robot came in and left by.
function starPicture(star, entry, exit) {
  const directions = directionsOf(star);
  const arms = star.ends.map((end, number) => {
    const [x, y] = [Math.cos(directions[number]), -Math.sin(directions[number])];
    const mark = number === entry ? "in" : number === exit ? "out" : "";
    const name = number === entry && number === exit ? "in, out" : mark;
    return [
      svg("line", { x1: 9 * x, y1: 9 * y, x2: 30 * x, y2: 30 * y, class: end.closed ? "arm closed" : "arm" }),
      end.closed
        ? svg("line", { x1: 30 * x - 7 * y, y1: 30 * y + 7 * x, x2: 30 * x + 7 * y, y2: 30 * y - 7 * x, class: "arm" })
        : arrow(36 * x, 36 * y, directions[number], "arm-head"),
      svg("text", { x: 50 * x, y: 50 * y + 4 }, name ? `${end.name} ${name}` : end.name),
    ];
  });
  const label = `Star ${star.name}: ${star.ends.map((end, number) => endWords(end, number === entry, number === exit)).join(", ")}`;
  return svg("svg", { viewBox: "-75 -65 150 130", class: "star", role: "img", "aria-label": label }, svg("circle", { r: 9 }), arms);
}

function endWords(end, isEntry, isExit) {
  const words = [end.closed ? "closed" : null, end.label, isEntry ? "came in" : null, isExit ? "left" : null].filter(Boolean);
  return words.length ? `${end.name} (${words.join(", ")})` : end.name;
}

// A little triangle that points somewhere.
function arrow(x, y, direction, name) {
  return svg("path", { d: "M 7 0 L -4 5 L -4 -5 Z", class: name, transform: `translate(${x} ${y}) rotate(${(-direction * 180) / Math.PI})` });
}

// An image that lies in a frame: y goes up there, and down in the picture.
function imageIn(image, name) {
  const href = `data:image/png;base64,${image.png}`;
  const turn = image.turn ? `rotate(${(-image.turn * 180) / Math.PI})` : null;
  return svg("g", { transform: turn }, svg("image", {
    href, x: image.x, y: -image.y - image.height, width: image.width, height: image.height, class: name, preserveAspectRatio: "none",
  }));
}

// The local map of a visit with the star over it.
function localMap(image, star, label) {
  const arms = directionsOf(star).map((direction, end) => {
    const reach = star.ends[end].closed ? 1.2 : 3;
    return svg("line", { x1: 0, y1: 0, x2: reach * Math.cos(direction), y2: -reach * Math.sin(direction), class: star.ends[end].closed ? "over closed" : "over" });
  });
  const half = Math.min(12, image.width / 2);
  return svg("svg", { viewBox: `${-half} ${-half} ${2 * half} ${2 * half}`, class: "local", role: "img", "aria-label": label },
    imageIn(image, "grid"), arms, svg("circle", { r: 0.3, class: "over" }));
}

