// Light or dark: as the system has it, or as the reader wants it here.

function startTheme() {
  const choice = byId("theme");
  const apply = theme => (theme ? document.documentElement.setAttribute("data-theme", theme) : document.documentElement.removeAttribute("data-theme"));
  choice.value = remembered() ?? "";
  apply(choice.value);
  choice.addEventListener("change", () => {
    apply(choice.value);
    remember(choice.value);
  });
}

// A browser may keep nothing for files: then the choice lasts as long as the page.
function remembered() {
  try {
    return localStorage.getItem("hssh-theme");
  } catch {
    return null;
  }
}

function remember(theme) {
  try {
    localStorage.setItem("hssh-theme", theme);
  } catch {
    // Nothing is kept.
  }
}

