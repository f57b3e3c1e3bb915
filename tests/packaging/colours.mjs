// Colours texts with the extension's grammars as VS Code does.
//
// usage: node colours.mjs MODULES SYNTAXES <CASES
// CASES is a JSON list of { "grammar": "slim", "text": "..." }. Prints a list for each case: its words that are not
// blanks or commas, as [line, word, innermost scope without the one of the whole file, or ""].
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [modules, syntaxes] = process.argv.slice(2).map((folder) => path.resolve(folder));
const require = createRequire(path.join(modules, "any.js"));
const { INITIAL, Registry, parseRawGrammar } = require("vscode-textmate");
const oniguruma = require("vscode-oniguruma");

await oniguruma.loadWASM(fs.readFileSync(path.join(modules, "node_modules/vscode-oniguruma/release/onig.wasm")).buffer);
const registry = new Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async (scope) => {
    const file = path.join(syntaxes, scope.replace("source.understudy.", "") + ".tmLanguage.json");
    return parseRawGrammar(fs.readFileSync(file, "utf8"), file);
  },
});

const coloured = [];
for (const { grammar, text } of JSON.parse(fs.readFileSync(0, "utf8"))) {
  const rules = await registry.loadGrammar("source.understudy." + grammar);
  const words = [];
  let stack = INITIAL;
  text.split(/\r?\n/).forEach((line, index) => {
    const { tokens, ruleStack } = rules.tokenizeLine(line, stack);
    stack = ruleStack;
    for (const { startIndex, endIndex, scopes } of tokens) {
      const scope = scopes.slice(1).filter((name) => !name.startsWith("meta.")).at(-1) ?? "";
      const word = line.slice(startIndex, endIndex).replace(/^[\s,]+|[\s,]+$/g, "");
      if (word !== "") words.push([index + 1, word, scope]);
    }
  });
  coloured.push(words);
}
process.stdout.write(JSON.stringify(coloured));
