// Pixels of a PNG as browsers write screenshots: 8 bits per channel, RGB or RGBA, not interlaced.
// Source: PNG Specification, third edition, sections 9 (filters) and 11 (chunks).

import {inflateSync} from "node:zlib";

const paeth = (a, b, c) => {
  const p = a + b - c, pa = Math.abs(p - a), pb = Math.abs(p - b), pc = Math.abs(p - c);
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
};

// A picture of `scale` pixels for each of the page's; at(x, y) takes those of the page.
export function readPng(bytes, scale = 1) {
  let width = 0, height = 0, channels = 0;
  const packed = [];
  for (let at = 8; at < bytes.length;) {
    const length = bytes.readUInt32BE(at), type = bytes.toString("latin1", at + 4, at + 8);
    const body = bytes.subarray(at + 8, at + 8 + length);
    if (type === "IHDR") {
      width = body.readUInt32BE(0);
      height = body.readUInt32BE(4);
      channels = {2: 3, 6: 4}[body[9]];
      if (body[8] !== 8 || !channels || body[12]) throw new Error("a kind of PNG that this reader does not know");
    }
    if (type === "IDAT") packed.push(body);
    at += 12 + length;
  }
  const lines = inflateSync(Buffer.concat(packed)), stride = width * channels, pixels = Buffer.alloc(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = lines[y * (stride + 1)];
    for (let i = 0; i < stride; ++i) {
      const left = i >= channels ? pixels[y * stride + i - channels] : 0, up = y ? pixels[(y - 1) * stride + i] : 0;
      const corner = y && i >= channels ? pixels[(y - 1) * stride + i - channels] : 0;
      const guess = [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter];
      pixels[y * stride + i] = lines[y * (stride + 1) + 1 + i] + guess;
    }
  }
  return {width, height, at: (x, y) => {
    const column = Math.round(x * scale), row = Math.round(y * scale);
    if (!(column >= 0 && column < width && row >= 0 && row < height)) throw new Error(`(${x}, ${y}) is not in the picture`);
    const start = row * stride + column * channels;
    return [...pixels.subarray(start, start + 3)];
  }};
}
