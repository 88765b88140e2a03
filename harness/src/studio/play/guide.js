// The guided crossing: a script over the steps that were taken, so that undo, a reload and a link have its place as well.

import { id } from "../shell/dom.js";

// A step as rows name it: by place and action, or by sender, receiver, fate and message.
const told = ({ action, place: { at, between } }) => between ? `${between.from}>${between.to} ${between.fate} ${action}` : `${at} ${action}`;

// Each row: the state in words, and what leads on from it: how the step begins, and the row after it.
export const ROWS = {
  start: ["A person waits at the kerb. Robot 1 detects people and has a sign; robot 2 can walk beside a person. They agree by radio, and each message may get lost.", { next: ["0 pedestrian detected", "help"] }],
  help: ["Robot 1 has detected the person and asks for one helper. Its message is a RAM: each robot tells its state by it, again and again. The sign shows stop, so the person waits.",
    { next: ["0>1 arrives RAM needHelp", "offer"], lose: ["0>1 lost RAM needHelp", "helpLost"] }],
  helpLost: ["The message is lost, and robot 2 knows of nobody. The person still waits, because the sign shows stop until a guard is known to be there. Robot 1 says its RAM again.", { next: ["0 timer ram", "help"] }],
  offer: ["Robot 2 offers its help and keeps itself free for this crossing. An offer is no guard yet: the sign shows stop.", { next: ["1>0 arrives RAM offerHelp", "select"] }],
  select: ["Robot 1 has the offer. It waits for more offers until its timer for the selection runs out. Then it names its helper.", { next: ["0 timer selection", "roles"] }],
  roles: ["Robot 1 is the leader now and names robot 2 as its follower. Robot 2 has not heard that yet, so the sign shows stop.", { next: ["0>1 arrives RAM leader", "joined"] }],
  joined: ["Robot 2 has joined as the follower and says so. Robot 1 does not count on it before this message arrives.", { next: ["1>0 arrives RAM follower", "command"] }],
  command: ["Robot 1 counts on robot 2 now, but for a limited time, the lease: only fresh messages of robot 2 prolong it. It can command robot 2 to move, which is to walk beside the person.",
    { next: ["0 command robot 2: move", "commanded"] }],
  commanded: ["The command is on its way, in a message called RMCM. The sign shows stop: a command that was sent may not have arrived.",
    { next: ["0>1 arrives RMCM command", "ack"], lose: ["0>1 lost RMCM command", "commandLost"] }],
  commandLost: ["The command is lost, and robot 2 does nothing. No acknowledgement comes, so the sign stays at stop and robot 1 sends the command again. The person waits longer; nothing worse happens.",
    { next: ["0 timer acknowledgement", "repeated"] }],
  repeated: ["The same command is on its way again. It has the same number, so that robot 2 starts it once, even if both arrive.", { next: ["0>1 arrives RMCM command", "ack"] }],
  ack: ["Robot 2 has started and acknowledges the command. The sign shows stop until robot 2 has also said that it is at work.", { next: ["1>0 arrives RMCM ack", "executing"] }],
  executing: ["Robot 2 says in its RAM that it carries out the command. Robot 1 needs this message before its sign may show go.",
    { next: ["1>0 arrives RAM follower, command 0 executing", "open"], lose: ["1>0 lost RAM follower, command 0 executing", "executingLost"] }],
  executingLost: ["The message is lost. Robot 1 does not know that robot 2 is at work, so the sign stays at stop and the person waits. Robot 2 says its RAM again.", { next: ["1 timer ram", "executing"] }],
  open: ["Robot 1 knows that robot 2 is at work. Now it may open the corridor: the sign shows go while the corridor is open.", { next: ["0 open corridor", "go"] }],
  go: ["The sign shows go. It returns to stop as soon as the lease runs out, or robot 1 hears that robot 2 cannot go on.", { next: ["0 at its sign somebody steps on the road", "road"] }],
  road: ["The person is on the road, and robot 2 is beside them. See property W1 below. What happens if robot 1 loses power now?",
    { next: ["0 who stepped on the road there is across", "across"], power: ["0 crashes", "dark"] }],
  across: ["The person is across. The next one comes to the kerb at once in this model. Robot 1 now ends the crossing, which returns its sign to stop.", { next: ["0 task completed", "ended"] }],
  ended: ["The sign shows go no more, and robot 1 says that the crossing has ended. Robot 2 stays a follower until it hears that.", { next: ["0>1 arrives RAM none, ended", "done"] }],
  done: ["The person is across, and both robots are idle. Undo leads back to each step: lose a message there, or let the leader lose power while the person is on the road.", {}],
  dark: ["Robot 1 has lost power: its sign is dark, and it sends nothing. Robot 2 does not walk off: it stays beside the person while its timer for contact, named safety, runs down.",
    { next: ["1 timer safety", "alone"] }],
  alone: ["Robot 2 has lost contact with its leader. It falls back: it stays beside the person to the nearer kerb (property W2, below). It says so, but robot 1 cannot hear it.", { next: ["1>0 lost RAM follower", "duty"] }],
  duty: ["Robot 2 is on duty without a leader. The end of a timer does not end this duty; a clear road does.", { next: ["0 who stepped on the road there is across", "clear"] }],
  clear: ["The person is across. The next one comes to the kerb at once in this model, and no sign shows go. Robot 2 stays on duty until it knows that the road is clear.", { next: ["1 road clear", "told"] }],
  told: ["The road is clear, and the duty of robot 2 is over. It says so; robot 1 cannot hear it.", { next: ["1>0 lost RAM follower", "leave"] }],
  leave: ["Robot 2 waits for its leader for a limited time. Then it leaves the crossing by itself.", { next: ["1 timer leave", "left"] }],
  left: ["Robot 2 has left and is idle. Robot 1 does not hear this message either.", { next: ["1>0 lost RAM none, left", "boot"] }],
  boot: ["Robot 1 gets power again. It goes on with no crossing from before, because it cannot know what has happened since; its sign does not show go.", { next: ["0 boots again", "booted"] }],
  booted: ["The person is across, and both robots are idle, although the leader failed at the worst moment. Undo leads back to each step.", {}],
};

const KINDS = ["next", "lose", "power"];

// The row after these steps, or which step is not in the script.
function placeOf(steps) {
  let row = "start";
  for (const [at, step] of steps.entries()) {
    const way = Object.values(ROWS[row][1]).find(([begins]) => told(step).startsWith(begins));
    if (!way) return { left: at };
    [, row] = way;
  }
  return { row };
}

// Choices of a row, as steps of the model.
export function choices(row, possible) {
  const ways = Object.entries(ROWS[row]?.[1] ?? {}).map(([kind, [begins]]) => [kind, possible.find((step) => told(step).startsWith(begins))]);
  return Object.fromEntries(ways.filter(([, step]) => step));
}

// Shows the guide where the play is in its script, or has just left it; the street is beside it then. Gives what it offers.
export function draw({ steps }, possible, isWanted, line) {
  const place = placeOf(steps), offered = choices(place.row, possible);
  const isShown = isWanted && (place.row !== undefined || place.left === steps.length - 1);
  const hadFocus = id("guide").contains(document.activeElement);
  id("guide").hidden = !isShown;
  id("guided").hidden = isShown;
  id(isShown ? "guide" : "left").insertBefore(id("street-section"), isShown ? null : id("left").firstChild);
  // One of the two speaks.
  id("said").setAttribute("aria-live", isShown ? "off" : "polite");
  if (!isShown) {
    if (hadFocus) id("guided").focus();
    return {};
  }
  id("guide-said").textContent = place.row ? ROWS[place.row][0]
    : `You left the guide: it does not go on from “${line(steps[place.left])}”. Undo leads back to it, or go on as you like.`;
  for (const kind of KINDS) id(`guide-${kind}`).hidden = !offered[kind];
  if (hadFocus) [...KINDS, "free"].map((kind) => id(`guide-${kind}`)).find((it) => !it.hidden).focus();
  return offered;
}
