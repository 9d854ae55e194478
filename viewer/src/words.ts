// SPDX-License-Identifier: MIT
// The words of the page, in each language.
import commonEn from './words/common.en.json';
import commonJa from './words/common.ja.json';
import panelsEn from './words/panels.en.json';
import panelsJa from './words/panels.ja.json';
import sceneEn from './words/scene.en.json';
import sceneJa from './words/scene.ja.json';
import tablesJa from './words/tables.ja.json';
import timelineEn from './words/timeline.en.json';
import timelineJa from './words/timeline.ja.json';

const en = {...commonEn, ...sceneEn, ...panelsEn, ...timelineEn};
const ja = {...commonJa, ...sceneJa, ...panelsJa, ...timelineJa};

export type Language = 'en' | 'ja';
export type Word = keyof typeof en;

const kWords: Record<Language, Record<Word, string>> = {en, ja};

let language: Language = 'en';

/** The language that the browser asks for. */
export const preferredLanguage = (): Language =>
  navigator.language.toLowerCase().startsWith('ja') ? 'ja' : 'en';

export function setLanguage(wanted: Language): void {
  language = wanted;
  document.documentElement.lang = wanted;
}

/** A text of the page; {0}, {1}, ... are replaced. */
export const t = (word: Word, ...values: (string | number)[]): string =>
  kWords[language][word].replace(/\{(\d)\}/g, (_, index) => String(values[Number(index)]));

/** The text of a word that may not be there, such as one made from a name of the core's tables. */
export const translated = (word: string, otherwise: string): string =>
  kWords[language][word as Word] ?? otherwise;

type Texts = Record<string, string>;

/** What the core's tables and sentences are in another language than English, which is theirs. */
interface CoreWords {
  operations: Texts;
  options: Texts;
  choices: Texts;
  texts: Texts;
  sentences: [pattern: RegExp, own: string][];
}

/** A sentence with places {0}, {1}, ... as what finds them. */
function patternOf(sentence: string): RegExp {
  const literal = sentence.replace(/[.*+?^$()|[\]\\]/g, '\\$&');
  return new RegExp(`^${literal.replace(/\{\d\}/g, '(.+?)')}$`);
}

const coreWords = (words: Record<keyof CoreWords, Texts>): CoreWords => ({
  ...words,
  sentences: Object.entries(words.sentences).map(([english, own]) => [patternOf(english), own]),
});

const kCoreWords: Partial<Record<Language, CoreWords>> = {ja: coreWords(tablesJa)};

/** The label of a name of the core's tables; the name itself if the language has none. */
export const nameOf = (table: 'operations' | 'options' | 'choices', name: string): string =>
  kCoreWords[language]?.[table][name] ?? name;

/** What the core says, by the first sentence that fits; undefined: none does. */
function sentenceOf(text: string, {texts, sentences}: CoreWords): string | undefined {
  const known = texts[text];
  if (known !== undefined) return known;
  for (const [pattern, own] of sentences) {
    const found = pattern.exec(text)?.slice(1);
    if (found !== undefined) return own.replace(/\{(\d)\}/g, (_, index) => found[Number(index)]);
  }
  return undefined;
}

/** A list of reasons; undefined: one of them is not known. */
function reasonsOf(text: string, words: CoreWords): string | undefined {
  const parts = text.split(', ').map((part) => sentenceOf(part, words));
  if (parts.includes(undefined)) return undefined;
  return new Intl.ListFormat(language).format(parts as string[]);
}

/** A text of the core in the page's language, where that is known; else as the core says it. */
export function fromCore(text: string): string {
  const words = kCoreWords[language];
  if (words === undefined) return text;
  const [first, axis, against] = text.split(/; for (.) speaks: /);
  const whole = sentenceOf(text, words) ?? reasonsOf(first, words);
  if (against === undefined || whole === undefined) return whole ?? text;
  return t('evidence_against', whole, axis, reasonsOf(against, words) ?? against);
}

/** Fills the elements that name their word: data-word is the text, data-title the title and label. */
export function fillWords(): void {
  for (const element of document.querySelectorAll<HTMLElement>('[data-word]')) {
    element.textContent = t(element.dataset.word as Word);
  }
  for (const element of document.querySelectorAll<HTMLElement>('[data-title]')) {
    const text = t(element.dataset.title as Word);
    element.title = text;
    element.setAttribute('aria-label', text);
  }
}
