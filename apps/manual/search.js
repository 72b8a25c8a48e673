/* search.js - finds sections of the manual. entries.js has them: [address, page, title, text, names explained there].
 * Nothing is loaded from a network. */
"use strict";

const filler = new Set(("a an and are by can defined definition do does for from how i in is it mean means of on " +
  "or the to what which with").split(" "));

/* The words of a text without fillers; "level.c" and "exponent-turns" are one word each. */
function words(text) {
  const all = text.toLowerCase().match(/[\p{L}\p{N}_]+([.-][\p{L}\p{N}_]+)*/gu) || [];
  const kept = all.filter((word) => !filler.has(word));
  return kept.length ? kept : all;
}

/* Finds the forms of a word: "effects" finds "effect". A short word is found whole. */
function pattern(word) {
  const stem = word.length > 4 ? word.replace(/(s|ed|ing)$/, "") : word;
  const end = stem.length < 3 ? "(?![\\p{L}\\p{N}])" : "";
  return new RegExp("(?<![\\p{L}\\p{N}])" + stem.replaceAll(".", "\\.") + end, "giu");
}

const count = (text, word) => (text.match(word) || []).length;

/* The stretch of a text that has most of the words: where it begins, and which part of them it has. */
function densest(text, asked) {
  const places = asked.flatMap((word, i) => [...text.matchAll(word)].map((found) => [found.index, i]));
  places.sort((a, b) => a[0] - b[0]);
  let from = 0, most = 0;
  for (const [at] of places) {
    const inside = new Set(places.filter(([other]) => other >= at && other < at + 60).map(([, i]) => i)).size;
    if (inside > most) [from, most] = [at, inside];
  }
  return { from, part: most / asked.length };
}

/* The sections that answer best. Rare words count more; so do words in a title, names that a section explains, and
 * words that are close together. */
function search(question, limit = 12) {
  const plain = words(question), asked = plain.map(pattern);
  const rare = asked.map((word) => {
    const having = entries.filter(([, , title, text]) => count(title, word) || count(text, word)).length;
    return Math.log(1 + entries.length / (1 + having));
  });
  const all = rare.reduce((sum, x) => sum + x, 0);
  const found = entries.map(([address, page, title, text, names]) => {
    let score = 0, has = 0;
    asked.forEach((word, i) => {
      const n = count(text, word), inTitle = count(title, word);
      if (n + inTitle) has += rare[i];
      score += rare[i] * (n / (n + 1 + text.length / 2000) + 2 * inTitle / words(title).length);
      if (names.some((name) => name.toLowerCase().replace(/^-+/, "") === plain[i])) score += rare[i];
    });
    const { from, part } = has ? densest(text, asked) : { from: 0, part: 0 };
    return { address, title: title === page ? page : page + ": " + title, text, from,
             score: score * (has / all) ** 2 * (1 + 3 * part) };
  });
  return found.filter((entry) => entry.score > 0).sort((a, b) => b.score - a.score).slice(0, limit);
}

/* --- the page */

/* A piece of a section's text, with the words marked. */
function extract({ text, from }, asked) {
  const begin = Math.max(0, from - 40), piece = text.slice(begin, begin + 220), part = document.createElement("p");
  let at = 0;
  part.append(begin ? "... " : "");
  for (const place of asked.flatMap((word) => [...piece.matchAll(word)]).sort((a, b) => a.index - b.index)) {
    if (place.index < at) continue;
    const mark = document.createElement("mark");
    mark.textContent = place[0];
    part.append(piece.slice(at, place.index), mark);
    at = place.index + place[0].length;
  }
  part.append(piece.slice(at), begin + 220 < text.length ? " ..." : "");
  return part;
}

function show(question, list) {
  const asked = words(question).map(pattern), found = search(question);
  list.replaceChildren(...found.map((entry) => {
    const item = document.createElement("li"), link = document.createElement("a");
    link.href = entry.address;
    link.textContent = entry.title;
    item.append(link, extract(entry, asked));
    return item;
  }));
  if (!found.length) list.append("Nothing is found.");
  list.hidden = !asked.length;
}

if (typeof document !== "undefined") {
  const field = document.getElementById("query"), list = document.getElementById("found");
  field.addEventListener("input", () => show(field.value, list));
  document.addEventListener("keydown", (event) => {
    if (event.key === "/" && event.target !== field) {
      event.preventDefault();
      field.focus();
    }
    if (event.key === "Escape") {
      field.value = "";
      list.hidden = true;
    }
  });
  list.addEventListener("click", () => { list.hidden = true; });
  document.getElementById("contents").open = matchMedia("(min-width: 64rem)").matches;
}
