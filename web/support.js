// What the program needs of a browser beside a way to draw.

/** A program of one function, which takes up and drops a vector of 128 bits: the least that only a browser with SIMD accepts. */
const VECTOR = [
  0x00, 0x61, 0x73, 0x6d, 1, 0, 0, 0, // "\0asm", version 1
  1, 4, 1, 0x60, 0, 0, // a type: nothing in, nothing out
  3, 2, 1, 0, // a function of that type
  10, 23, 1, 21, 0, 0xfd, 12, ...new Array(16).fill(0), 0x1a, 0x0b, // v128.const 0, drop, end
];

/** Whether WebAssembly is there, with SIMD, as the program is built with it. */
export function runsProgram() {
  return typeof WebAssembly === "object" && WebAssembly.validate(new Uint8Array(VECTOR));
}
