// News of the same exploration, if the page was served by a program that goes on mapping.

let source = null;

function listen(url) {
  if (source?.asked === url) return;
  source?.close();
  source = null;
  if (!url) return;
  source = new EventSource(url);
  source.asked = url;
  source.onopen = () => say("live");
  // The browser tries again by itself; a source that is closed for good is over.
  source.onerror = () => say(source.readyState === EventSource.CLOSED ? "no more news: the program has ended" : "no connection, trying again");
  source.onmessage = event => renderData({ ...state.data, ...JSON.parse(event.data) });
}

function say(words) {
  byId("live").textContent = words;
}

