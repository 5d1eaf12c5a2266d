// The menus of the header: they close by Escape, by a click elsewhere, and when something was chosen.

/** @param {ParentNode} root */
export function startMenus(root) {
  const menus = /** @type {HTMLDetailsElement[]} */ ([...root.querySelectorAll("details.menu")]);
  const close = (/** @type {Element | null} */ except) => {
    for (const menu of menus) if (menu !== except) menu.open = false;
  };
  addEventListener("pointerdown", (event) => {
    close(event.target instanceof Element ? event.target.closest("details.menu") : null);
  });
  for (const menu of menus) {
    menu.addEventListener("toggle", () => menu.open && close(menu));
    menu.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || !menu.open) return;
      event.preventDefault();
      closeMenu(menu);
    });
  }
}

/** Closes a menu and gives the focus back to its button. @param {HTMLDetailsElement} menu */
export function closeMenu(menu) {
  menu.open = false;
  menu.querySelector("summary")?.focus();
}
