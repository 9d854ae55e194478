// SPDX-License-Identifier: MIT
// The toolbar of the scene: from where it is seen, and what is shown in it.
import {button, byId, el} from '../elements.ts';
import type {Scene} from '../scene/scene.ts';
import type {Camera, Shown, Store} from '../state.ts';
import {t} from '../words.ts';

const kCameras: Camera[] = ['orbit', 'follow', 'front', 'side', 'top'];
const kShown: (keyof Shown)[] = ['ghosts', 'paths', 'contacts', 'zmp', 'axes', 'names', 'shapes'];

/** Makes the toolbar; a toggle is there only where there is something to show. */
export function makeViews(store: Store, scene: Scene): void {
  const bar = byId('views');
  const cameras = el('div', {class: 'row', attributes: {role: 'group'}});
  const toggles = el('div', {class: 'row toggles', attributes: {role: 'group'}, id: 'shown'});
  bar.append(cameras, toggles);
  /** On small screens the toggles are behind a button. */
  let isOpen = false;

  const camera = (name: Camera) =>
    button(t(name), () => store.set({camera: name}), {
      title: t(`${name}_title`),
      pressed: store.state.camera === name,
    });

  const toggle = (name: keyof Shown) => {
    const {shown} = store.state;
    return button(t(name), () => store.set({shown: {...shown, [name]: !shown[name]}}), {
      title: t(`${name}_title`),
      pressed: shown[name],
    });
  };

  /** Replaces buttons; the focus stays with the button that took the place of the focused one. */
  const replace = (row: HTMLElement, buttons: HTMLElement[]) => {
    const focused = [...row.children].indexOf(document.activeElement!);
    row.replaceChildren(...buttons);
    if (focused >= 0) (row.children[focused] as HTMLElement | undefined)?.focus();
  };

  const draw = () => {
    const more = button('⋯', openToggles, {title: t('shown'), class: 'more'});
    more.setAttribute('aria-expanded', String(isOpen));
    more.setAttribute('aria-controls', toggles.id);
    replace(cameras, [
      ...kCameras.map(camera),
      button(t('fit'), scene.frameAll, {title: t('frame_all')}),
      more,
    ]);
    cameras.setAttribute('aria-label', t('views'));
    const {now} = scene.offers;
    replace(toggles, kShown.filter((name) => now[name]).map(toggle));
    toggles.setAttribute('aria-label', t('shown'));
    toggles.classList.toggle('open', isOpen);
    bar.hidden = store.state.motions.length === 0;
  };
  const openToggles = () => {
    isOpen = !isOpen;
    draw();
  };

  store.on(['camera', 'shown', 'language', 'motions'], draw);
  scene.offers.on(draw);
}
