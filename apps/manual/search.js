/* search.js - finds sections of the manual. entries.js has them: [address, title, text]. Nothing is loaded. */
"use strict";

const filler = new Set("a an and are by can do does for from how i in is it mean means of on or the to what which with".split(" "));

/* The words of a question, each as an expression that finds its forms: "effects" finds "effect". "level.c" is one. */
function words(query) {
  const all = query.toLowerCase().match(/[\p{L}\p{N}_]+([.-][\p{L}\p{N}_]+)*/gu) || [];
  const kept = all.filter((word) => !filler.has(word));
  return (kept.length ? kept : all).map((word) => {
    const stem = word.length > 4 ? word.replace(/(s|ed|ing)$/, "") : word;
    return new RegExp("(?<![\\p{L}\\p{N}])" + stem.replace(".", "\\.") + (stem.length < 3 ? "(?![\\p{L}\\p{N}])" : ""), "giu");
  });
}

const count = (text, word) => (text.match(word) || []).length;

/* The stretch of a text that has most of the words: where it begins. */
function densest(text, asked, width) {
  const places = asked.flatMap((word, i) => [...text.matchAll(word)].map((found) => [found.index, i]));
  let best = 0, most = 0;
  for (const [from] of places) {
    const inside = new Set(places.filter(([at]) => at >= from && at < from + width).map(([, i]) => i)).size;
    if (inside > most || (inside === most && from < best)) [best, most] = [from, inside];
  }
  return { from: best, share: asked.length ? most / asked.length : 0 };
}

/* The sections that answer best: rare words count more, and so do words in the title, or close together. */
function search(query, limit = 12) {
  const asked = words(query);
  if (!asked.length) return [];
  const rare = asked.map((word) => {
    const having = entries.filter(([, title, text]) => count(title, word) || count(text, word)).length;
    return Math.log(1 + entries.length / (1 + having));
  });
  const all = rare.reduce((sum, x) => sum + x, 0);
  const scored = entries.map(([address, title, text]) => {
    let score = 0, has = 0;
    asked.forEach((word, i) => {
      const n = count(text, word) + 5 * count(title, word);
      if (n) has += rare[i];
      score += rare[i] * n / (n + 1 + text.length / 2000);
    });
    if (!has) return { score: 0 };
    const close = densest(text, asked, 160);
    return { address, title, text, from: close.from, score: score * (has / all) ** 2 * (1 + 2 * close.share) };
  });
  return scored.filter((entry) => entry.score > 0).sort((a, b) => b.score - a.score).slice(0, limit);
}

/* --- the page */

function show(query, list) {
  const asked = words(query);
  const found = search(query);
  list.replaceChildren(...found.map(({ address, title, text, from }) => {
    const item = document.createElement("li"), link = document.createElement("a"), part = document.createElement("p");
    link.href = address;
    link.textContent = title;
    const begin = Math.max(0, from - 40), piece = text.slice(begin, begin + 220);
    let at = 0;
    const places = asked.flatMap((word) => [...piece.matchAll(word)]).sort((a, b) => a.index - b.index);
    part.append(begin ? "... " : "");
    for (const place of places.filter((p) => p.index >= at)) {
      const mark = document.createElement("mark");
      mark.textContent = place[0];
      part.append(piece.slice(at, place.index), mark);
      at = place.index + place[0].length;
    }
    part.append(piece.slice(at), begin + 220 < text.length ? " ..." : "");
    item.append(link, part);
    return item;
  }));
  if (query.trim() && !found.length) list.append("Nothing is found.");
  list.hidden = !query.trim();
}

if (typeof document !== "undefined") {
  const field = document.getElementById("query"), list = document.getElementById("found");
  field.addEventListener("input", () => show(field.value, list));
  document.addEventListener("keydown", (event) => {
    if (event.key === "/" && event.target !== field) { event.preventDefault(); field.focus(); }
    if (event.key === "Escape") { field.value = ""; show("", list); }
  });
  list.addEventListener("click", () => { list.hidden = true; });
  document.getElementById("contents").open = matchMedia("(min-width: 64rem)").matches;
}
