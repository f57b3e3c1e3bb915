// Validates JSON files by VS Code's own schemas, as VS Code does when an author opens them.
//
// usage: node schemas.mjs MODULES FILE=SCHEMA...
// SCHEMA is the last part of vscode://schemas/SCHEMA. Prints a JSON list of [file, line, what is wrong].
import fs from "node:fs";
import { createRequire, register } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const modules = path.resolve(process.argv[2]);
const code = (packageName) =>
  pathToFileURL(path.join(modules, "node_modules/@codingame", packageName, "vscode/src/vs/")).href;
const api = code("monaco-vscode-api");

// VS Code's parts import style sheets, and ask a browser who it is.
const hooks = `export const load = (url, context, next) => /\\.css$/.test(url)
  ? { format: "module", source: "export default {}", shortCircuit: true } : next(url, context);`;
register("data:text/javascript," + encodeURIComponent(hooks), import.meta.url);
const element = () => ({ style: {}, setAttribute() {}, appendChild() {} });
globalThis.window = globalThis;
globalThis.document = { createElement: element, head: element(), body: element(), documentElement: element() };
globalThis.matchMedia = () => ({ matches: false, addEventListener() {} });

const { Registry } = await import(api + "platform/registry/common/platform.js");
const { Extensions } = await import(api + "platform/jsonschemas/common/jsonContributionRegistry.js");
for (const part of [
  "workbench/services/extensions/common/extensionsRegistry.js",
  "workbench/services/language/common/languageService.js",
  "workbench/services/textMate/common/TMGrammars.js",
  "workbench/contrib/tasks/common/problemMatcher.js",
  "workbench/contrib/codeEditor/common/languageConfigurationExtensionPoint.js",
]) {
  await import(api + part);
}
await import(code("monaco-vscode-debug-service-override") + "workbench/contrib/debug/common/debugSchemas.js");
const schemas = Registry.as(Extensions.JSONContribution).getSchemaContributions().schemas;

const { getLanguageService, TextDocument } = createRequire(path.join(modules, "any.js"))("vscode-json-languageservice");
const service = getLanguageService({
  schemaRequestService: async (uri) => JSON.stringify(schemas[uri.replace(/#$/, "")] ?? {}),
});
const found = [];
for (const pair of process.argv.slice(3)) {
  const [file, schema] = pair.split("=");
  const uri = "vscode://schemas/" + schema;
  if (!(uri in schemas)) throw new Error(uri + " is not a schema");
  const document = TextDocument.create(pathToFileURL(file).href, "json", 1, fs.readFileSync(file, "utf8"));
  const json = service.parseJSONDocument(document);
  for (const { range, message } of await service.doValidation(document, json, undefined, { $ref: uri })) {
    found.push([path.basename(file), range.start.line + 1, message]);
  }
}
fs.writeSync(1, JSON.stringify(found));
process.exit(0);
