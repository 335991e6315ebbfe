import { readFileSync } from "node:fs";
import ts from "typescript";
import { expect, it } from "vitest";

const read = (path: string): string => readFileSync(new URL(`../../${path}`, import.meta.url), "utf8");
const snake = (name: string): string => name.replace(/(?!^)[A-Z]/g, (letter) => `_${letter}`).toLowerCase();

// The messages that the program takes, with their members: those that need not be have a mark.
function taken(): Record<string, string[]> {
  const [, body = ""] = /enum WindowMessage \{\n(.*?)\n\}\n/s.exec(read("src/studio/messages.rs")) ?? [],
    plain = body.replace(/^\s*\/\/\/.*\n/gm, "");
  return Object.fromEntries(
    [...plain.matchAll(/^ {4}(\w+)(?: \{\n(.*?)\n {4}\})?,$/gms)].map(([, name, members = ""]) => [
      snake(name!),
      [...members.matchAll(/(#\[serde\(default\)\]\s*)?^ {8}(\w+): (.*),$/gm)].map(
        ([, isDefault, member]) => `${member}${isDefault ? "?" : ""}`,
      ),
    ]),
  );
}

// Those that a window says.
function said(): Record<string, string[]> {
  const file = ts.createSourceFile("messages.ts", read("studio/src/messages.ts"), ts.ScriptTarget.Latest),
    found = file.statements.find((one) => ts.isInterfaceDeclaration(one) && one.name.text === "Said");
  const named = (members: ts.NodeArray<ts.TypeElement>) =>
    [...members].filter(ts.isPropertySignature).map((one) => ({
      name: (one.name as ts.Identifier).text,
      mark: one.questionToken ? "?" : "",
      inner: one.type && ts.isTypeLiteralNode(one.type) ? one.type.members : null,
    }));
  return Object.fromEntries(
    named((found as ts.InterfaceDeclaration).members).map(({ name, inner }) => [
      name,
      inner ? named(inner).map((one) => one.name + one.mark) : [],
    ]),
  );
}

it("a window says what the program takes, and nothing else", () => {
  const [own, program] = [said(), taken()],
    bare = (all: string[] | undefined) => all?.map((one) => one.replace("?", "")).sort();
  expect(Object.keys(program).length).toBeGreaterThan(20);
  expect(Object.keys(own).sort()).toEqual(Object.keys(program).sort());
  for (const [name, members] of Object.entries(program)) {
    expect(bare(own[name]), name).toEqual(bare(members));
    // What the program needs is said in any case.
    for (const member of members) if (!member.endsWith("?")) expect(own[name], name).toContain(member);
  }
});
