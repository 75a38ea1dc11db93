// Arrays out of base64, little-endian, as every machine with a browser is.

export function decode_base64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

// An array of `Type`; `count` numbers are expected, at `place` in the scene.
export function decode_array(Type, text, count, place) {
  const bytes = decode_base64(text);
  if (bytes.length !== count * Type.BYTES_PER_ELEMENT)
    throw new Error(`${place}: ${bytes.length} bytes, expected ${count * Type.BYTES_PER_ELEMENT}`);
  return new Type(bytes.buffer, bytes.byteOffset, count);
}
