// What the page loads, as files beside it.

export const asset = async (name) => {
  const answer = await fetch(new URL(name, document.baseURI));
  if (!answer.ok) throw new Error(`${name}: ${answer.status} ${answer.statusText}`);
  return answer.arrayBuffer();
};
export const quadrupedView = () => import("./quadruped_view.js");
