// SPDX-License-Identifier: MIT
// A button that copies a text, and says that it did.
import {button} from '../elements.ts';
import {t, type Word} from '../words.ts';

const kToldMilliseconds = 1500;

/** Makes the button; `text` is asked for when it is pressed. */
export function copyButton(word: Word, text: () => string): HTMLButtonElement {
  const made = button(t(word), async () => {
    await navigator.clipboard.writeText(text());
    made.textContent = t('copied');
    setTimeout(() => {
      made.textContent = t(word);
    }, kToldMilliseconds);
  });
  made.classList.add('copy');
  return made;
}
