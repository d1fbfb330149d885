// Elements from plain data. Whatever is shown goes in as text, never as markup.

const SVG = "http://www.w3.org/2000/svg";

const byId = id => document.getElementById(id);

function element(name, attributes, ...children) {
  return filled(document.createElement(name), attributes, children);
}

function svg(name, attributes, ...children) {
  return filled(document.createElementNS(SVG, name), attributes, children);
}

// Attributes that are false, null or undefined are left out; functions listen to the event of their name.
function filled(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (typeof value === "function") node.addEventListener(name, value);
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter(child => child !== null && child !== undefined && child !== false));
  return node;
}

// Puts other content into an element that stays.
function refill(node, ...children) {
  node.replaceChildren();
  return filled(node, null, children);
}

function button(text, click, attributes) {
  return element("button", { type: "button", click, ...attributes }, text);
}

// A table of rows; cells are texts, numbers or elements. Names of columns that end in # are of numbers.
function table(columns, rows, caption) {
  const kind = columns.map(column => (column.endsWith("#") ? "number" : null));
  const head = columns.map((column, index) => element("th", { scope: "col", class: kind[index] }, column.replace(/#$/, "")));
  const cells = row => row.map((cell, index) => element("td", { class: kind[index] }, cell ?? ""));
  return element(
    "div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
    element("table", {}, element("caption", {}, caption), element("thead", {}, element("tr", {}, head)),
      element("tbody", {}, rows.map(row => element("tr", row.attributes ?? {}, cells(row.cells ?? row))))));
}

// A part that is opened by hand, and made only then: long lists do not delay the page. It is open again after the next
// rendering if it was before.
function fold(id, title, make) {
  const open = byId(id)?.open ?? false;
  const node = element("details", { id }, element("summary", {}, title));
  const fill = () => node.childElementCount === 1 && node.append(make());
  node.addEventListener("toggle", () => node.open && fill());
  node.fill = fill;
  if (open) {
    fill();
    node.open = true;
  }
  return node;
}

// The sign and the word say it without any color.
function banner(tone, sign, word, sentence) {
  return element("p", { class: `banner ${tone}` }, element("span", { class: "sign", "aria-hidden": "true" }, sign), element("strong", {}, word), " ", element("span", {}, sentence));
}

// What is printed is printed as a whole.
window.addEventListener("beforeprint", () => {
  for (const node of document.querySelectorAll("details")) {
    node.fill?.();
    node.open = true;
  }
});

