// The search of mkdocs-material runs in a worker, and browsers start none for pages that are opened as files. There a
// hidden frame stands in for it, and the index is a script (search_index.js) instead of a request.
if (location.protocol === 'file:') {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      this.waiting = [];
      const frame = document.createElement('iframe');
      frame.hidden = true;
      document.body.append(frame);
      this.inner = frame.contentWindow;
      this.inner.postMessage = data => this.dispatchEvent(new MessageEvent('message', {data}));
      const script = frame.contentDocument.createElement('script');
      script.src = url;
      script.onload = () => {
        const waiting = this.waiting;
        this.waiting = undefined;
        for (const data of waiting) this.postMessage(data);
      };
      frame.contentDocument.body.append(script);
    }
    postMessage(data) {
      if (this.waiting) this.waiting.push(data);
      else this.inner.dispatchEvent(new this.inner.MessageEvent('message', {data}));
    }
    terminate() {}
  };
}
