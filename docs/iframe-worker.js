/** A worker for pages that are opened as files, where browsers allow none: its script runs in a frame that is not shown. */
class FrameWorker extends EventTarget {
  constructor(address) {
    super();
    const frame = document.createElement("iframe");
    frame.hidden = true;
    document.body.append(frame);
    this.room = frame.contentWindow;
    // What the script sends comes out here, as from a worker.
    this.room.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
    const script = frame.contentDocument.createElement("script");
    this.loaded = new Promise((resolve) => script.addEventListener("load", resolve));
    script.src = new URL(address, document.baseURI).href;
    frame.contentDocument.body.append(script);
  }

  postMessage(data) {
    this.loaded.then(() => this.room.dispatchEvent(new this.room.MessageEvent("message", { data })));
  }
}

if (location.protocol === "file:") {
  window.Worker = FrameWorker;
}
