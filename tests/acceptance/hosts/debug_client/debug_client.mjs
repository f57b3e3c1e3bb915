// VS Code's own test client (@vscode/debugadapter-testsupport) drives `understudy dap`, for each language of programs.
// The environment variable UNDERSTUDY is the program, MODULES the folder of the Node modules.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import fs from "node:fs";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import { test } from "node:test";

const { UNDERSTUDY, MODULES } = process.env;
const { DebugClient } = createRequire(path.join(MODULES, "package.json"))("@vscode/debugadapter-testsupport");
const PATIENCE_MS = 60_000;  // for events that come, not for how fast they do

// For each language: a program that sets `name` to 7 before its line `call`, and ends some milliseconds later. In those
// that have routines, line `call` calls the routine that begins at line `routine`. Line `remark` has no instruction; a
// breakpoint there moves to line `next`. `start` begins the program in the debug console. The scope of the program shows
// `name` as `shown`.
const LANGUAGES = {
  "simple2-r3": {
    file: "wait.lst", axis: "A", start: "PROG_MAIN_RunTime_START = 0", call: 3, behind: 4, remark: 1, next: 2, name: "PROG_VAR0", shown: "VAR32",
    text: "; waits\n        VAR_Direct VAR32 7\n        Delay_mSec 5\n        Delay_mSec 6\n        END\n",
  },
  "rs-m8194h": {
    file: "wait.mac", axis: "X", start: "CALL_MPn = 41", call: 4, behind: 5, routine: 9, remark: 1, next: 2, name: "VAR1",
    text: "MP 41\n  RSM_MACRO_SET_VAR VAR1 7\n  RSM_MACRO_TIMER 5\n  RSM_MACRO_MP_CALL 2\n  RSM_MACRO_TIMER 5\nEND\n" +
          "MP 2\n  RSM_MACRO_TIMER 5\n  RSM_MACRO_TIMER 6\n  RSM_MACRO_TIMER 7\nEND\n",
  },
  "super-40nc": {
    file: "wait.40nc.lst", axis: "X", start: "M8000 = 1", call: 4, behind: 5, routine: 7, remark: 1, next: 2, name: "D0",
    text: "AREA C\nMOV K7 D0\nTMR K20\nCAL K100 K1\nTMR K30\nEND\nLAB K100\nTMR K20\nTMR K30\nRET\nAREA PLC\nEND\n",
  },
  slim: {
    file: "wait.slim", axis: "T0", start: "command G", call: 4, behind: 5, routine: 7, remark: 1, next: 2, name: "N1",
    text: "\nN1=7\nWT 5\nCALL 5\nWT 6\nRET\n$5 WT 7\nWT 8\nRET\n",
  },
};

/** Writes a bench of one device with the program, and returns the paths. */
function bench(t, model) {
  const { file, text } = LANGUAGES[model];
  const folder = fs.mkdtempSync(path.join(fs.realpathSync(os.tmpdir()), "debug_client-"));
  t.after(() => fs.rmSync(folder, { recursive: true, force: true }));
  const program = path.join(folder, file);
  fs.writeFileSync(program, text);
  const yaml = path.join(folder, "bench.yaml");
  fs.writeFileSync(yaml, "understudy: 1\nlines:\n  a: { stations: [ { name: m, model: " + model + ", program: " + file +
                         " } ] }\n");
  return { folder, program, yaml };
}

/** A client with an adapter of its own. The adapter must end with exit code 0. */
async function client(t) {
  const one = new DebugClient(UNDERSTUDY, "dap", "understudy");
  one.defaultTimeout = PATIENCE_MS;
  await one.start();
  const adapter = one._adapterProcess;
  const ended = once(adapter, "exit");
  let is_over = false;
  one.end = async () => {
    if (is_over) return;
    is_over = true;
    adapter.stdin.end();
    assert.deepEqual(await ended, [0, null]);
  };
  t.after(() => one.end());
  return one;
}

/** A launched session that stands before the first instruction, and has these breakpoints. */
async function launched(t, model, breakpoints = []) {
  const { program, yaml } = bench(t, model);
  const dc = await client(t);
  const entry = dc.waitForEvent("stopped");
  const initialized = dc.waitForEvent("initialized");
  await dc.launch({ bench: yaml, stopOnEntry: true });
  await initialized;
  const set = (await dc.setBreakpointsRequest({ source: { path: program }, breakpoints })).body.breakpoints;
  await dc.configurationDoneRequest();
  assert.equal((await entry).body.reason, "entry");
  return { dc, program, set };
}

const begin = (dc, model) => dc.evaluateRequest({ expression: LANGUAGES[model].start, context: "repl" });
const value = async (dc, expression) => (await dc.evaluateRequest({ expression })).body.result;

/** Returns the event of the stop after a request. */
async function stop_after(dc, request) {
  const [stopped] = await Promise.all([dc.waitForEvent("stopped"), request]);
  return stopped.body;
}

/** Returns the first frame, after the client's own check of reason, path and line. */
async function stops_at(dc, request, reason, program, line) {
  const [stack] = await Promise.all([dc.assertStoppedLocation(reason, { path: program, line }), request]);
  return stack.body.stackFrames[0];
}

const refused = (request, says) => assert.rejects(request, (error) => {
  assert.match(error.message, says);
  assert.ok(!error.message.includes("\n"), error.message);
  return true;
});

for (const model of Object.keys(LANGUAGES)) {
  const language = LANGUAGES[model];

  test(model + ": a breakpoint is hit by the client's own scenario", async (t) => {
    const { program, yaml } = bench(t, model);
    const dc = await client(t);
    const hit = dc.hitBreakpoint({ bench: yaml }, { path: program, line: language.call });
    await dc.waitForEvent("initialized");
    await begin(dc, model);
    await hit;
    await dc.disconnectRequest();
  });

  test(model + ": lines, conditions, hits, logpoints, and lines without an instruction", async (t) => {
    const { call, behind, remark, next, name } = language;
    const { dc, program, set } = await launched(t, model, [
      { line: remark, condition: name + " == 1000" },
      { line: call, logMessage: "now {" + name + "}" },
      { line: behind, hitCondition: "2" },
      { line: 900 },
      { line: call, condition: name + " ==" },
      { line: call, condition: "NOTHING == 1" },
      { line: call, hitCondition: "often" },
    ]);
    assert.deepEqual(set.map((one) => one.verified), [true, true, true, false, false, false, false]);
    assert.equal(set[0].line, next);
    assert.match(set[0].message, /moved/);
    for (const [place, says] of [[3, /900/], [4, /column/], [5, /NOTHING/], [6, /often/]]) assert.match(set[place].message, says);
    await begin(dc, model);
    const [, first] = await Promise.all([dc.assertOutput("console", "now 7\n"),
                                         stop_after(dc, dc.continueRequest({ threadId: 1 }))]);
    assert.equal(first.reason, "pause");  // the program has ended: it was the first hit
    await begin(dc, model);
    const frame = await stops_at(dc, dc.continueRequest({ threadId: 1 }), "breakpoint", program, behind);
    assert.equal((await dc.evaluateRequest({ expression: name, frameId: frame.id })).body.result, "7");
    await dc.setBreakpointsRequest({ source: { path: program }, breakpoints: [] });
    assert.equal((await stop_after(dc, dc.continueRequest({ threadId: 1 }))).reason, "pause");
    await dc.disconnectRequest();
  });

  test(model + ": breakpoints on data, on instructions and on events", async (t) => {
    const { call, behind, name } = language;
    const { dc, program } = await launched(t, model, [{ line: call }]);
    const info = (await dc.dataBreakpointInfoRequest({ name })).body;
    assert.ok(info.dataId, info.description);
    assert.equal((await dc.dataBreakpointInfoRequest({ name: "NOTHING" })).body.dataId, null);
    const data = await dc.setDataBreakpointsRequest({ breakpoints: [{ dataId: info.dataId, condition: name + " == 7" }] });
    assert.equal(data.body.breakpoints[0].verified, true);
    await begin(dc, model);
    assert.equal((await stop_after(dc, dc.continueRequest({ threadId: 1 }))).reason, "data breakpoint");
    await dc.setDataBreakpointsRequest({ breakpoints: [] });
    const frame = await stops_at(dc, dc.continueRequest({ threadId: 1 }), "breakpoint", program, call);
    const list = (await dc.disassembleRequest({ memoryReference: frame.instructionPointerReference, instructionOffset: 0,
                                                instructionCount: 30 })).body.instructions;
    assert.equal(list[0].line, call);
    const instruction = list.find((one) => one.line === behind).address;
    const set = await dc.customRequest("setInstructionBreakpoints", { breakpoints: [{ instructionReference: instruction }] });
    assert.equal(set.body.breakpoints[0].verified, true);
    await stops_at(dc, dc.continueRequest({ threadId: 1 }), "instruction breakpoint", program, behind);
    await dc.customRequest("setInstructionBreakpoints", { breakpoints: [] });
    const events = await dc.setExceptionBreakpointsRequest({ filters: ["fault"] });
    assert.equal(events.body.breakpoints[0].verified, true);
    await refused(dc.setFunctionBreakpointsRequest({ breakpoints: [] }), /unknown/);
    await dc.disconnectRequest();
  });

  test(model + ": an event from outside stops an attached bench", async (t) => {
    const { folder, yaml } = bench(t, model);
    const control = path.join(folder, "control");
    const served = spawn(UNDERSTUDY, ["serve", yaml, "--control", control]);
    t.after(() => served.kill());
    await once(served.stdout, "data");
    const dc = await client(t);
    const initialized = dc.waitForEvent("initialized");
    await dc.initializeRequest();
    await dc.attachRequest({ control });
    await initialized;
    await dc.setExceptionBreakpointsRequest({ filters: ["fault"] });
    await dc.configurationDoneRequest();
    const stopped = dc.waitForEvent("stopped");
    const said = spawnSync(UNDERSTUDY, ["ctl", "--control", control, "inject", "stall", "m." + language.axis], { encoding: "utf8" });
    assert.equal(said.status, 0, said.stderr);
    assert.equal((await stopped).body.reason, "exception");
    await dc.disconnectRequest();
    await dc.end();
    const left = spawnSync(UNDERSTUDY, ["ctl", "--control", control, "break"], { encoding: "utf8" });
    assert.deepEqual([left.status, left.stdout], [0, ""]);
  });

  test(model + ": steps to and fro", async (t) => {
    const { call, behind, routine } = language;
    const { dc, program } = await launched(t, model, [{ line: call }]);
    await begin(dc, model);
    const stopped = await stop_after(dc, dc.continueRequest({ threadId: 1 }));
    const thread = { threadId: stopped.threadId };
    const at_call = await value(dc, "time");
    const into = await stops_at(dc, dc.stepInRequest(thread), "step", program, routine ?? behind);
    assert.ok(into.id > 0);
    if (routine !== undefined) {
      await stops_at(dc, dc.nextRequest({ ...thread, granularity: "instruction" }), "step", program);
      await stops_at(dc, dc.stepOutRequest(thread), "step", program, behind);
      await stops_at(dc, dc.reverseContinueRequest(thread), "breakpoint", program, call);
      assert.equal(await value(dc, "time"), at_call);
      await stops_at(dc, dc.nextRequest(thread), "step", program, behind);
    }
    await dc.setBreakpointsRequest({ source: { path: program }, breakpoints: [] });
    const at_behind = await value(dc, "time");
    await stop_after(dc, dc.stepBackRequest(thread));
    assert.ok(parseFloat(await value(dc, "time")) < parseFloat(at_behind));
    await stops_at(dc, dc.stepInRequest(thread), "step", program, behind);
    assert.equal(await value(dc, "time"), at_behind);
    assert.match((await stop_after(dc, dc.stepOutRequest(thread))).text, /no routine is running/);
    await dc.disconnectRequest();
  });

  test(model + ": threads, scopes, variables, set, evaluate, completions, sources", async (t) => {
    const { call, name, shown = name } = language;
    const { dc, program } = await launched(t, model, [{ line: call }]);
    await begin(dc, model);
    const frame = await stops_at(dc, dc.continueRequest({ threadId: 1 }), "breakpoint", program, call);
    assert.ok((await dc.threadsRequest()).body.threads.length > 0);
    const scopes = (await dc.scopesRequest({ frameId: frame.id })).body.scopes;
    assert.deepEqual(scopes.slice(0, 4).map((scope) => scope.name), ["State", "Program", "Axes", "Terminals"]);
    for (const { variablesReference, name: of } of scopes) {
      const { variables } = (await dc.variablesRequest({ variablesReference, start: 0, count: 50 })).body;
      for (const one of variables) assert.equal(typeof one.value, "string", of + ": " + one.name);
    }
    const { variablesReference } = scopes[1];
    const known = (await dc.variablesRequest({ variablesReference })).body.variables;
    assert.equal(known.find((one) => one.name === shown)?.value, "7");
    assert.equal((await dc.setVariableRequest({ variablesReference, name: shown, value: "4 + 1" })).body.value, "5");
    assert.equal((await dc.customRequest("setExpression", { expression: name, value: "6", frameId: frame.id })).body.value, "6");
    for (const context of ["watch", "hover", "repl"]) {
      const { body } = await dc.evaluateRequest({ expression: name + " * 2", frameId: frame.id, context });
      assert.equal(body.result, "12");
    }
    await refused(dc.evaluateRequest({ expression: name + " *", frameId: frame.id }), /column/);
    await refused(dc.evaluateRequest({ expression: "NOTHING", frameId: frame.id }), /NOTHING/);
    const { targets } = (await dc.completionsRequest({ text: name.slice(0, 1), column: 2, frameId: frame.id })).body;
    assert.ok(targets.length > 0);
    const lines = await dc.customRequest("breakpointLocations", { source: { path: program }, line: 1, endLine: 99 });
    assert.ok(lines.body.breakpoints.some((one) => one.line === call));
    await refused(dc.modulesRequest({}), /unknown/);
    await refused(dc.restartFrameRequest({ frameId: frame.id }), /unknown/);
    await dc.disconnectRequest();
  });

  test(model + ": restart, and a disconnect in the midst", async (t) => {
    const { call, name } = language;
    const { dc, program } = await launched(t, model, [{ line: call }]);
    for (let time = 0; time < 2; ++time) {
      await begin(dc, model);
      await stops_at(dc, dc.continueRequest({ threadId: 1 }), "breakpoint", program, call);
      assert.equal(await value(dc, name), "7");
      assert.equal((await stop_after(dc, dc.restartRequest({}))).reason, "entry");
      assert.equal(await value(dc, name), "0");
      assert.match(await value(dc, "time"), /^0/);
    }
    await refused(dc.launchRequest({ bench: program }), /launch/);
    await dc.continueRequest({ threadId: 1 });  // for an hour of simulated time
    await dc.disconnectRequest();
    await dc.end();
  });
}

test("a client that goes without a word ends the adapter and its bench", async (t) => {
  const { dc } = await launched(t, "slim");
  await begin(dc, "slim");
  await dc.continueRequest({ threadId: 1 });
  await dc.end();
});

test("two clients are refused", async (t) => {
  const server = spawn(UNDERSTUDY, ["dap", "--listen", "127.0.0.1:0"]);
  const ended = once(server, "exit");
  const [said] = await once(server.stdout, "data");
  const port = Number(/:(\d+)\s*$/.exec(String(said))[1]);
  const first = new DebugClient(UNDERSTUDY, "dap", "understudy");
  const second = new DebugClient(UNDERSTUDY, "dap", "understudy");
  await first.start(port);
  await first.initializeRequest();
  await second.start(port);
  await refused(second.initializeRequest(), /another client is connected/);
  const { yaml } = bench(t, "simple2-r3");
  const initialized = first.waitForEvent("initialized");
  await first.launchRequest({ bench: yaml, stopOnEntry: true });
  await initialized;
  await first.configurationDoneRequest();
  assert.equal(await value(first, "1 + 2"), "3");
  await first.stop();
  server.kill();
  await ended;
});

test("a bench that cannot be opened is said in one sentence", async (t) => {
  const dc = await client(t);
  await dc.initializeRequest();
  await refused(dc.configurationDoneRequest(), /expected `launch` or `attach` first/);
  await refused(dc.launchRequest({ bench: "/none.yaml" }), /none\.yaml/);
  await refused(dc.attachRequest({ control: "/none" }), /none/);
  await dc.disconnectRequest();
});
