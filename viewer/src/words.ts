// SPDX-License-Identifier: MIT
// The words of the page, in each language.
import commonEn from './words/common.en.json';
import commonJa from './words/common.ja.json';
import panelsEn from './words/panels.en.json';
import panelsJa from './words/panels.ja.json';
import sceneEn from './words/scene.en.json';
import sceneJa from './words/scene.ja.json';
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
