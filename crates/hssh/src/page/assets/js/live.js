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
  source.onmessage = event => {
    const news = JSON.parse(event.data);
    renderData(news.format ? { ...news, live: state.data.live } : { ...state.data, ...news });
  };
  source.addEventListener("robot", event => {
    state.robot = JSON.parse(event.data);
    markRobot(byId("map-picture"), state.robot);
  });
  source.addEventListener("end", () => {
    source.close();
    state.robot = null;
    say("the robot has arrived: nothing more will come");
    render();
  });
}

function say(words) {
  byId("live").textContent = words;
}

