// The files of the built page. They lie beside index.html and are all of one version, which their addresses
// name: a browser that has kept a file of another version asks for the new one.

/** The address of a file. @param {string} name */
export function addressOf(name) {
  return new URL(`${name}?v=${document.documentElement.dataset.version}`, document.baseURI).href;
}

/**
 * A file that is stored compressed by gzip, as it was before. Rejects if it cannot be had.
 * @param {string} name
 * @param {string} type
 */
export async function unpacked(name, type) {
  const { ok, status, body } = await fetch(addressOf(name));
  if (!ok || !body) throw new Error(`the server answered ${status} for ${name}`);
  // Some servers tell the browser to unpack such a file: then it is unpacked already.
  const [content, copy] = body.tee();
  const reader = copy.getReader();
  const { value } = await reader.read();
  reader.cancel().catch(() => {});
  const isPacked = value?.[0] === 0x1f && value[1] === 0x8b;
  const stream = isPacked ? content.pipeThrough(new DecompressionStream("gzip")) : content;
  return new Response(stream, { headers: { "Content-Type": type } });
}
