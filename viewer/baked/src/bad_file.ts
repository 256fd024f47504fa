// What is wrong with the file, for one line to the reader of the page.
export type FileFault = "missing" | "unserved" | "foreign" | "cut" | "damaged" | "newer";

export class BadFile extends Error {
  constructor(
    readonly fault: FileFault,
    detail = "",
  ) {
    super(detail);
  }
}
