// A headset by WebXR: the home in its true size; the trigger goes to the place on the floor that is pointed at.
import * as THREE from "three";
import type { Vec3 } from "../../src/vector.js";
import type { Mover } from "./mover.js";
import type { Stage } from "./stage.js";
import { hasHeadroom, kEyeHeightM } from "./walk.js";

export async function headsetSupported(): Promise<boolean> {
  return (await navigator.xr?.isSessionSupported("immersive-vr").catch(() => false)) ?? false;
}

const kRayM = 8;
const kFloorSlope = 0.6;

export class Headset {
  private readonly rig = new THREE.Group(); // where the floor under the wearer is
  private readonly camera = new THREE.PerspectiveCamera(60, 1, 0.05, 1000);
  private readonly marker = new THREE.Mesh(
    new THREE.RingGeometry(0.15, 0.2, 32).rotateX(-Math.PI / 2),
    new THREE.MeshBasicMaterial({ color: 0xf0b954 }),
  );
  private target: Vec3 | null = null;
  private hand = 0; // the controller that points: whose trigger was pressed last

  constructor(
    private readonly stage: Stage,
    private readonly mover: Mover,
  ) {
    this.rig.add(this.camera);
    this.marker.visible = false;
  }

  // Once the headset has agreed, pictures are `frame`'s and the headset's until the wearer ends it: then `ended`.
  async enter(agreed: () => void, frame: (nowMs: number) => void, ended: () => void): Promise<void> {
    const { renderer, scene } = this.stage;
    const session = await navigator.xr!.requestSession("immersive-vr", { optionalFeatures: ["local-floor"] });
    agreed();
    const [x, y, z] = this.mover.eye.position;
    this.rig.position.set(x, y - kEyeHeightM, z);
    this.rig.rotation.y = (this.mover.eye.yawDeg * Math.PI) / 180;
    for (const i of [0, 1]) {
      const controller = renderer.xr.getController(i);
      controller.addEventListener("selectstart", this.hands[i]!);
      controller.addEventListener("selectend", this.jump);
      this.rig.add(controller);
    }
    renderer.xr.setReferenceSpaceType("local-floor");
    this.present(true);
    const leave = () => {
      renderer.xr.setAnimationLoop(null);
      for (const i of [0, 1]) {
        renderer.xr.getController(i).removeEventListener("selectstart", this.hands[i]!);
        renderer.xr.getController(i).removeEventListener("selectend", this.jump);
      }
      this.stand(this.rig.position.clone().add(this.aside).toArray());
      this.present(false);
      ended();
    };
    try {
      await renderer.xr.setSession(session);
    } catch (error) {
      await session.end().catch(() => undefined);
      leave();
      throw error;
    }
    session.addEventListener("end", leave); // after the renderer's own listener
    renderer.xr.setAnimationLoop(nowMs => {
      const eyes = renderer.getRenderTarget(); // of the headset
      frame(nowMs);
      this.marker.visible = false; // not in reflections
      this.stage.reflect();
      this.aim();
      this.stage.surfaces.orderPanes(new THREE.Vector3().setFromMatrixPosition(renderer.xr.getCamera().matrixWorld));
      renderer.setRenderTarget(eyes);
      renderer.clear();
      renderer.render(scene, this.camera);
    });
  }

  private present(on: boolean): void {
    const { renderer, scene, display } = this.stage;
    renderer.xr.enabled = display.uniforms.uEncode!.value = scene.matrixWorldAutoUpdate = on;
    if (on) {
      scene.add(this.rig, this.marker);
      return;
    }
    scene.remove(this.rig, this.marker);
    this.marker.geometry.dispose();
    this.marker.material.dispose();
  }

  private readonly hands = [0, 1].map(i => () => {
    this.hand = i;
    this.aim();
  });

  // The place on a floor that is pointed at, if one can stand there.
  private aim(): void {
    const controller = this.stage.renderer.xr.getController(this.hand);
    const from = new THREE.Vector3().setFromMatrixPosition(controller.matrixWorld);
    const d = new THREE.Vector3(0, 0, -1).transformDirection(controller.matrixWorld);
    const { world } = this.stage;
    const hit = world?.raycast([from.x, from.y, from.z], [d.x, d.y, d.z], kRayM);
    this.target = null;
    if (world && hit) {
      const n = world.normalOf(hit.triangle);
      const at: Vec3 = [from.x + d.x * hit.distance, from.y + d.y * hit.distance, from.z + d.z * hit.distance];
      if (Math.abs(n[1]) > kFloorSlope * Math.hypot(...n) && d.y < 0 && hasHeadroom(world, at)) this.target = at;
    }
    this.marker.visible = this.target !== null;
    if (this.target) this.marker.position.set(this.target[0], this.target[1] + 0.01, this.target[2]);
  }

  // How far the wearer stands from the middle of the rig.
  private get aside(): THREE.Vector3 {
    return this.camera.position.clone().setY(0).applyQuaternion(this.rig.quaternion);
  }

  private readonly jump = (): void => {
    if (!this.target) return;
    this.rig.position.set(...this.target).sub(this.aside);
    this.stand(this.target);
    this.stage.setEye(this.mover.eye); // reflections are those of the room
  };

  // The eye of the page stands where the wearer does.
  private stand([x, y, z]: readonly number[]): void {
    this.mover.stand({ ...this.mover.eye, position: [x!, y! + kEyeHeightM, z!] });
  }
}
