// The model in WebAssembly, apart from the page so that a long search does not hold it up: see harness/web.

const model = fetch(new URL("./model.wasm", import.meta.url)).then((file) => {
  if (!file.ok) throw new Error(`the model is not beside the pages: shell/model.wasm, ${file.status}`);
  return file.arrayBuffer();
}).then((octets) => WebAssembly.instantiate(octets)).then((it) => it.instance.exports);

async function ask(text) {
  const { room, answer, length, memory } = await model;
  const octets = new TextEncoder().encode(text);
  // Each call may grow the memory, and its buffer is another one then.
  const question = room(octets.length);
  new Uint8Array(memory.buffer, question, octets.length).set(octets);
  const [at, octetsOfAnswer] = [answer(), length()];
  return new TextDecoder().decode(new Uint8Array(memory.buffer, at, octetsOfAnswer));
}

onmessage = async ({ data, ports: [back] }) => back.postMessage(await ask(data).catch((error) => `-${error.message}`));
