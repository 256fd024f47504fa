// A triangle that covers all of a target, and the shader of its corners.
import * as THREE from "three";

export const kScreenVertex = `
  in vec3 position;
  void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }`;

export function screenTriangle(): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
  return geometry;
}
