// SPDX-License-Identifier: MIT
// The bar at the top: choosing files, dropping them, the state of work, language, help.
import type {Actions, GivenFile} from '../actions.ts';
import {byId, el} from '../elements.ts';
import {chosenFiles, droppedFiles} from '../files.ts';
import type {Store} from '../state.ts';
import {type Language, t, type Word} from '../words.ts';
import {iconButton, titled} from './icons.ts';

const kLanguages: readonly Language[] = ['en', 'ja'];
const kLanguageKey = 'kinefile.language';

/** The language that was chosen before; null: none, or the browser keeps nothing. */
export function chosenLanguage(): Language | null {
  try {
    const kept = localStorage.getItem(kLanguageKey);
    return kLanguages.find((language) => language === kept) ?? null;
  } catch {
    return null;
  }
}

function keepLanguage(language: Language): void {
  try {
    localStorage.setItem(kLanguageKey, language);
  } catch {
    // It is asked of the browser again next time.
  }
}

/** Shows what the page is busy with, and messages until they are closed or outdated. */
export function makeStatus(store: Store): void {
  const status = byId('status');
  const text = el('span');
  const close = iconButton('close', () => store.set({message: ''}), {class: 'plain'});
  status.append(text, close);
  store.on(['busy', 'message', 'language'], ({busy, message}) => {
    text.textContent = message || (busy ? t(busy as Word) : '');
    text.title = message;
    status.classList.toggle('message', message !== '');
    close.hidden = message === '';
    titled(close, t('dismiss'));
  });
}

/** Opens what is chosen or dropped; what comes before the core is there waits for it. */
export function takeFiles(store: Store, ready: Promise<Actions>): void {
  const open = async (reading: Promise<GivenFile[]>) => {
    try {
      const files = await reading;
      await (await ready).openFiles(files);
    } catch (fault) {
      store.set({busy: '', message: String(fault)});
    }
  };
  for (const id of ['choose-files', 'choose-folder']) {
    const input = byId<HTMLInputElement>(id);
    input.addEventListener('change', async () => {
      if (input.files) await open(chosenFiles(input.files));
      input.value = '';
    });
  }
  const hint = byId('drop-hint');
  let depth = 0;
  document.addEventListener('dragenter', () => {
    depth += 1;
    hint.hidden = false;
  });
  document.addEventListener('dragleave', () => {
    depth -= 1;
    hint.hidden = depth <= 0;
  });
  document.addEventListener('dragover', (event) => event.preventDefault());
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    depth = 0;
    hint.hidden = true;
    if (event.dataTransfer !== null) open(droppedFiles(event.dataTransfer.items));
  });
}

/** The tools at the end of the bar. */
export function makeTools(store: Store, openHelp: () => void): void {
  const language = el('select', {id: 'language'}, [
    el('option', {value: 'en', lang: 'en'}, ['English']),
    el('option', {value: 'ja', lang: 'ja'}, ['日本語']),
  ]);
  language.addEventListener('change', () => {
    keepLanguage(language.value as Language);
    store.set({language: language.value as Language});
  });
  const help = iconButton('help', openHelp, {class: 'help-button'});
  const panels = iconButton('panels', () => store.set({isSideOpen: !store.state.isSideOpen}), {
    class: 'side-button',
  });
  const bare = iconButton('shown', () => store.set({isBare: !store.state.isBare}), {
    class: 'bare-button',
  });
  byId('tools').append(language, bare, panels, help);
  const toggle = byId('side-toggle');
  toggle.addEventListener('click', () => store.set({isSideOpen: !store.state.isSideOpen}));
  store.on(['isSideOpen', 'isBare', 'motions', 'files', 'language'], (state) => {
    const {isSideOpen, isBare, motions, files} = state;
    // The messages of a file that could not be read are in the panel, too.
    const hasNone = motions.length === 0 && files.every(({what}) => what !== 'fault');
    language.value = state.language;
    titled(language, 'Language / 言語');
    titled(help, t('help'));
    titled(panels, t('panels'));
    titled(bare, t('key_bare'));
    panels.setAttribute('aria-pressed', String(isSideOpen));
    bare.setAttribute('aria-pressed', String(isBare));
    toggle.setAttribute('aria-expanded', String(isSideOpen));
    panels.hidden = bare.hidden = toggle.hidden = hasNone;
    byId('side').hidden = !isSideOpen || isBare || hasNone;
    document.body.classList.toggle('is-bare', isBare);
  });
}
