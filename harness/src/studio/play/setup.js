// Scenario files: the kit's, with room for more to happen, and one's own.

const MUCH = 200;

// Events that may happen as often as somebody at the page wants them to.
const BOUNDS = ["detections", "commands", "disturbances", "crashes", "restarts", "hangs"].map((name) => `${name} = ${MUCH}`).join("\n");

// Sections of a file by their heads; what stands before the first has the head "".
function sections(text) {
  return text.split(/^(?=\[)/m).map((body) => ({ head: /^\[+([^\]]*)\]/.exec(body)?.[1] ?? "", body }));
}

// A scenario of the kit in which more may happen than in a check of all its states. On a monotone channel, and with
// insiders that lie, it stays as it is: there the bounds are part of what is shown.
export function withRoom(name, text) {
  if (/^monotone *= *true|^lies *=/m.test(text)) return null;
  const kept = sections(text).filter(({ head }) => head !== "expected" && head !== "bounds").map(({ body }) => body);
  const [top, ...rest] = kept;
  const renamed = top.replace(/^name *=.*$/m, `name = "${name}-with-room"`).replace(/^symmetric *=.*\n/m, "");
  return [renamed, ...rest].join("").trimEnd() + `\n\n[bounds]\n${BOUNDS}\n`;
}

// Robots of one's own; stations count from 1.
export function own({ robots, detecting, followers, task, delayed }) {
  const each = Array.from({ length: robots }, (_, place) => `[[robots]]\nstation = ${place + 1}\n${place < detecting ? "detects = true\n" : ""}`);
  return `name = "my-street"
summary = "${robots} robots on a street"
corridor = true
properties = ["I1", "I2", "I3", "I4", "I6", "I8", "I9", "I11", "I13", "I14", "I16", "I17", "I18", "W1", "W2", "W4"]

${each.join("\n")}
[request]
followers = ${followers}
tasks = ["${task}"]

[channel]
delayed = ${delayed}
loss = true

[bounds]
${BOUNDS}
`;
}

export const nameIn = (text) => /^name *= *"([^"]*)"/m.exec(text)?.[1] ?? "scenario";
