// Makes what is shown another by touching only what differs: the browser lays out and paints anew
// whatever is written.
//
// Charts out of sight are left until they are in view.

// Makes an element's content that of another. Own children that `kept` matches are left alone, and
// so are those of the other (a script made what they hold).
export function patch(own: Element, wanted: Element | DocumentFragment, kept?: string): void {
  const left = (node: Node): boolean => kept !== undefined && node instanceof Element && node.matches(kept);
  const old = [...own.childNodes].filter((node) => !left(node)),
    fresh = [...wanted.childNodes].filter((node) => !left(node));
  fresh.forEach((node, k) => {
    const there = old[k];
    if (!there) {
      if (k > 0) old[k - 1]!.after(node);
      else own.prepend(node);
      old[k] = node;
    } else if (there.nodeName !== node.nodeName) {
      there.replaceWith(node);
      old[k] = node;
    } else if (there instanceof Element && node instanceof Element) {
      dress(there, node);
      patch(there, node, kept);
    } else if (there.nodeValue !== node.nodeValue) there.nodeValue = node.nodeValue;
  });
  for (const node of old.slice(fresh.length)) own.removeChild(node);
}

// The attributes of another element.
function dress(own: Element, wanted: Element): void {
  for (const { name } of [...own.attributes]) if (!wanted.hasAttribute(name)) own.removeAttribute(name);
  for (const { name, value } of wanted.attributes) if (own.getAttribute(name) !== value) own.setAttribute(name, value);
}
