// helper.js - the Workers of the laboratory, in which the library computes (worker.js).

// A Worker with the library. ask() gives a promise; after stop() what was asked is never answered.
class Helper {
  constructor() {
    this.asked = new Map();
    this.count = 0;
  }

  static async prepare() {
    const packed = Uint8Array.from(atob(element("library").textContent.trim()), (c) => c.charCodeAt(0)),
      stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    Helper.module = await WebAssembly.compile(await new Response(stream).arrayBuffer());
    Helper.code = URL.createObjectURL(new Blob([element("loader").textContent], { type: "text/javascript" }));
  }

  ask(job, scene, options) {
    if (!this.worker) {
      this.worker = new Worker(Helper.code);
      this.worker.postMessage({ module: Helper.module });
      this.worker.onmessage = ({ data }) => {
        const { resolve, reject } = this.asked.get(data.id);
        this.asked.delete(data.id);
        if (data.error === undefined) resolve(data.result);
        else reject(new Error(data.error));
      };
    }
    const id = this.count++;
    this.worker.postMessage({ id, job, scene, options });
    return new Promise((resolve, reject) => this.asked.set(id, { resolve, reject }));
  }

  // Ends the Worker if it still computes.
  stop() {
    if (!this.asked.size) return;
    this.worker.terminate();
    this.worker = null;
    this.asked.clear();
  }
}
