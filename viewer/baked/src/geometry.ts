// All triangles of a home: one set of vertices, and lists of triangles that are drawn with the same textures and
// states. Without textures one list serves all materials: what they are is looked up by the number that each vertex
// carries.
import { BadFile } from "./bad_file.js";
import { viewBytes, type Gltf, type Material } from "./document.js";

// Images by their number in the file.
export interface Maps {
  readonly base: number | null;
  readonly normal: number | null;
  readonly roughness: number | null;
  readonly emission: number | null;
}

// In place of an image: one of those that are packed into one texture.
export const kPacked = -1;
const kGrey = 1.1; // channels of a colour differ by no more
const kMostLists = 100; // before images are packed
const kMostPacked = 256; // layers that every GPU can have

export interface Batch {
  readonly kind: "opaque" | "mask" | "pane" | "tinted"; // a pane that colours what is behind it
  readonly doubleSided: boolean;
  readonly maps: Maps;
  readonly normalScale: number;
  readonly index: Uint32Array;
}

export interface Geometry {
  readonly positions: Float32Array; // 3 a vertex, m
  readonly normals: Int8Array; // 4
  readonly uvs: Float32Array | null; // 2, of textures
  readonly lightUvs: Uint16Array; // 2, normalised
  readonly colors: Uint8Array | null; // 4
  readonly tags: Uint16Array; // 2: material, whether light is that of its vertices
  readonly index: Uint32Array; // of all batches, one after the other
  readonly batches: readonly Batch[];
  readonly packed: readonly number[]; // images of base colours that share one texture
}

const kComponents: Readonly<Record<string, number>> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
const kByte = 5120;
const kUnsignedByte = 5121;
const kUnsignedShort = 5123;
const kUnsignedInt = 5125;
const kFloat = 5126;
const kRepeat = 10497;
const kBytes: Readonly<Record<number, number>> = {
  [kByte]: 1,
  [kUnsignedByte]: 1,
  [kUnsignedShort]: 2,
  [kUnsignedInt]: 4,
  [kFloat]: 4,
};

type Store = Float32Array | Int8Array | Uint8Array | Uint16Array | Uint32Array;

// Copies an accessor to `to`, `stride` numbers an element; numbers are taken as they are stored.
function copyAccessor(
  document: Gltf,
  binary: Uint8Array,
  at: number,
  allowed: readonly number[],
  components: number,
  to: Store,
  offset: number,
  stride: number,
): void {
  const where = `accessors.${at}`;
  const accessor = document.accessors[at]!;
  const { componentType, count } = accessor;
  if (!allowed.includes(componentType) || kComponents[accessor.type] !== components)
    throw new BadFile("damaged", `${where}: ${accessor.type} of ${componentType}`);
  const bytes = viewBytes(document, binary, accessor.bufferView);
  const size = kBytes[componentType]!;
  const step = document.bufferViews[accessor.bufferView]!.byteStride ?? size * components;
  if (count > 0 && accessor.byteOffset + step * (count - 1) + size * components > bytes.length)
    throw new BadFile("damaged", `${where}: ends behind its buffer view`);
  const view = new DataView(bytes.buffer, bytes.byteOffset + accessor.byteOffset);
  const read = {
    [kByte]: (b: number) => view.getInt8(b),
    [kUnsignedByte]: (b: number) => view.getUint8(b),
    [kUnsignedShort]: (b: number) => view.getUint16(b, true),
    [kUnsignedInt]: (b: number) => view.getUint32(b, true),
    [kFloat]: (b: number) => view.getFloat32(b, true),
  }[componentType]!;
  for (let i = 0; i < count; ++i)
    for (let c = 0; c < components; ++c) to[offset + i * stride + c] = read(i * step + c * size);
}

const countOf = (document: Gltf, at: number | undefined, what: string): number => {
  const accessor = at === undefined ? undefined : document.accessors[at];
  if (!accessor) throw new BadFile("damaged", `${what}: missing`);
  return accessor.count;
};

export function isPane(material: Material | undefined): boolean {
  return (
    material?.alphaMode === "BLEND" || (material?.extensions.KHR_materials_transmission?.transmissionFactor ?? 0) > 0
  );
}

// Whether what passes a pane is coloured.
function isTinted({
  pbrMetallicRoughness: { baseColorFactor: rgba, baseColorTexture },
  extensions,
}: Material): boolean {
  if (!((extensions.KHR_materials_transmission?.transmissionFactor ?? 0) > 0)) return false;
  const [r, g, b] = rgba;
  return baseColorTexture !== undefined || Math.max(r, g, b) > kGrey * Math.min(r, g, b);
}

function kindOf(material: Material | undefined): Batch["kind"] {
  if (material && isPane(material)) return isTinted(material) ? "tinted" : "pane";
  return material?.alphaMode === "MASK" ? "mask" : "opaque";
}

export function mapsOf(document: Gltf, material: Material | undefined): Maps {
  const image = (texture: { readonly index: number } | undefined) =>
    (texture && document.textures[texture.index]?.source) ?? null;
  return {
    base: image(material?.pbrMetallicRoughness.baseColorTexture),
    normal: image(material?.normalTexture),
    roughness: image(material?.pbrMetallicRoughness.metallicRoughnessTexture),
    emission: image(material?.emissiveTexture),
  };
}

// Images that are repeated base colours of solid materials without other images.
function packable(document: Gltf, material: Material): boolean {
  const base = material.pbrMetallicRoughness.baseColorTexture;
  const { wrapS, wrapT } = document.samplers[document.textures[base?.index ?? -1]?.sampler ?? -1] ?? {};
  const solid = material.alphaMode === "OPAQUE" && !isPane(material);
  return solid && (wrapS ?? kRepeat) === kRepeat && (wrapT ?? kRepeat) === kRepeat;
}

function imagesToPack(document: Gltf): number[] {
  const images = document.materials.flatMap(material => {
    const { base, normal, roughness, emission } = mapsOf(document, material);
    const alone = normal === null && roughness === null && emission === null && !isPane(material);
    return base !== null && alone && packable(document, material) ? [base] : [];
  });
  const all = [...new Set(images)];
  return all.length > kMostLists ? all.slice(0, kMostPacked) : [];
}

export function readGeometry(document: Gltf, binary: Uint8Array): Geometry {
  const primitives = document.meshes.flatMap(mesh => mesh.primitives);
  const counts = primitives.map((p, i) => countOf(document, p.attributes.POSITION, `primitive ${i}: POSITION`));
  const vertices = counts.reduce((sum, count) => sum + count, 0);
  const has = (name: string) => primitives.some(p => p.attributes[name] !== undefined);
  const positions = new Float32Array(3 * vertices);
  const normals = new Int8Array(4 * vertices);
  const uvs = has("TEXCOORD_0") ? new Float32Array(2 * vertices) : null;
  const lightUvs = new Uint16Array(2 * vertices);
  const colors = has("COLOR_0") ? new Uint8Array(4 * vertices).fill(255) : null;
  const tags = new Uint16Array(2 * vertices);
  const lists = new Map<string, { of: Omit<Batch, "index">; parts: Uint32Array[] }>();
  const packed = imagesToPack(document);
  let first = 0;
  primitives.forEach((primitive, i) => {
    const count = counts[i]!;
    const fill = (name: string, types: readonly number[], components: number, to: Store | null, stride: number) => {
      const at = primitive.attributes[name];
      if (at === undefined || !to) return;
      if (countOf(document, at, name) !== count) throw new BadFile("damaged", `primitive ${i}: ${name}: its count`);
      copyAccessor(document, binary, at, types, components, to, first * stride, stride);
    };
    fill("POSITION", [kFloat, kUnsignedShort], 3, positions, 3);
    fill("NORMAL", [kByte], 3, normals, 4);
    fill("TEXCOORD_0", [kFloat], 2, uvs, 2);
    fill("TEXCOORD_1", [kUnsignedShort], 2, lightUvs, 2);
    fill("COLOR_0", [kUnsignedByte], 4, colors, 4);
    fill("_VERTEX_LIT", [kUnsignedByte], 1, tags.subarray(1), 2);
    const number = primitive.material ?? document.materials.length; // the one behind the last: none
    for (let vertex = first; vertex < first + count; ++vertex) tags[2 * vertex] = number;
    const material = document.materials[number];
    const of = {
      kind: kindOf(material),
      doubleSided: material?.doubleSided ?? false,
      maps: packedMaps(mapsOf(document, material), material !== undefined && packable(document, material), packed),
      normalScale: material?.normalTexture?.scale ?? 1,
    } as const;
    const key = JSON.stringify(of);
    const list = lists.get(key) ?? { of, parts: [] };
    lists.set(key, list);
    list.parts.push(readIndex(document, binary, primitive.indices, first, count, `primitive ${i}`));
    first += count;
  });
  placeInWorld(positions, document.nodes[0]);
  const total = [...lists.values()].flatMap(list => list.parts).reduce((sum, part) => sum + part.length, 0);
  const index = new Uint32Array(total);
  const batches: Batch[] = [];
  let at = 0;
  for (const { of, parts } of lists.values()) {
    const from = at;
    for (const part of parts) {
      index.set(part, at);
      at += part.length;
    }
    batches.push({ ...of, index: index.subarray(from, at) });
  }
  return { positions, normals, uvs, lightUvs, colors, tags, index, batches, packed };
}

// Positions may be whole numbers of steps: the one node says how long, and from where.
function placeInWorld(positions: Float32Array, node: Gltf["nodes"][number] | undefined): void {
  if (!node) return;
  const { scale, translation } = node;
  for (let i = 0; i < positions.length; ++i) positions[i] = positions[i]! * scale[i % 3]! + translation[i % 3]!;
}

function packedMaps(maps: Maps, allowed: boolean, packed: readonly number[]): Maps {
  const alone = maps.normal === null && maps.roughness === null && maps.emission === null;
  return allowed && alone && maps.base !== null && packed.includes(maps.base) ? { ...maps, base: kPacked } : maps;
}

function readIndex(
  document: Gltf,
  binary: Uint8Array,
  accessor: number | undefined,
  first: number,
  vertices: number,
  where: string,
): Uint32Array {
  const count = accessor === undefined ? vertices : countOf(document, accessor, `${where}: indices`);
  const index = new Uint32Array(count - (count % 3));
  if (accessor === undefined) index.forEach((_, i) => (index[i] = i));
  else {
    const all = new Uint32Array(count);
    copyAccessor(document, binary, accessor, [kUnsignedByte, kUnsignedShort, kUnsignedInt], 1, all, 0, 1);
    index.set(all.subarray(0, index.length));
  }
  for (let i = 0; i < index.length; ++i) {
    if (index[i]! >= vertices) throw new BadFile("damaged", `${where}: an index beyond its vertices`);
    index[i]! += first;
  }
  return index;
}
