// SPDX-License-Identifier: Apache-2.0
// The words of the page, from the table of its language.

let table = {};
let language = 'en';

export function useTexts(texts, lang) {
  table = texts;
  language = lang;
}

/** The text of a key with its places {} or {0} filled. */
export function t(key, ...values) {
  let next = 0;
  return (table[key] ?? key).replace(/\{(\d*)\}/g, (_, place) => String(values[place === '' ? next++ : Number(place)]));
}

export const languageOf = () => language;
