// What the page asks of the server. All addresses are relative: they go on from the token in the page's own.

/** The state, as soon as it is another than `after`. */
export async function state(after, signal) {
  const answer = await fetch(`state?after=${after}`, { signal });
  if (!answer.ok) throw new Error(await answer.text());
  return answer.json();
}

/** The picture, developed: `{ number, width, height, bytes }`; null where there is none yet. */
export async function frame(look) {
  const answer = await fetch(`frame?${new URLSearchParams(look)}`);
  if (answer.status === 409) return null;
  if (!answer.ok) throw new Error(await answer.text());
  const [width, height] = answer.headers.get("x-size").split("x").map(Number);
  const bytes = new Uint8ClampedArray(await answer.arrayBuffer());
  return { number: Number(answer.headers.get("x-frame")), width, height, bytes };
}

/** Sends JSON; gives the answer's JSON, or null where it has none. */
export async function post(place, body) {
  const answer = await fetch(place, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
  });
  if (!answer.ok) throw new Error(await answer.text());
  return answer.status === 204 ? null : answer.json();
}
