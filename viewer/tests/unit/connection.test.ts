import assert from "node:assert/strict";
import { test } from "node:test";
import { retryDelayMs, tokenOf } from "../../src/connection.js";

test("the token stands behind the # of the link, or in its query", () => {
  assert.equal(tokenOf({ hash: "#abc", search: "" }), "abc");
  assert.equal(tokenOf({ hash: "#token=abc", search: "" }), "abc");
  assert.equal(tokenOf({ hash: "", search: "?token=abc" }), "abc");
  assert.equal(tokenOf({ hash: "", search: "" }), "");
});

test("the delay grows from half a second to fifteen, and no further", () => {
  assert.equal(retryDelayMs(0, 1), 500);
  assert.equal(retryDelayMs(3, 1), 4000);
  assert.equal(retryDelayMs(40, 1), 15000);
  assert.equal(retryDelayMs(0, 0), 375);
});
