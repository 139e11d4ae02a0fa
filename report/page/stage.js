// SPDX-License-Identifier: LGPL-2.1-or-later
// What every view in space of a page has: camera, light, controls, meshes, the label under the pointer.

/** The stage in a figure for things of a given size; null without WebGL, and then the figure is hidden. */
function makeStage(figure, size) {
  'use strict';

  const frame = figure.querySelector('.stage');
  const canvas = figure.querySelector('canvas');
  const label = figure.querySelector('.label');

  // What paper shows if the reader leaves the page as it is.
  figure.hidden = false;
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ canvas: canvas, antialias: true, alpha: true });
  } catch (error) {
    figure.hidden = true;
    return null;
  }
  document.documentElement.classList.add('webgl');

  function unpack(text, ArrayType) {
    const bytes = Uint8Array.from(atob(text), character => character.charCodeAt(0));
    return new ArrayType(bytes.buffer);
  }

  function geometryOf(mesh) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(unpack(mesh.points, Float32Array), 3));
    geometry.setIndex(new THREE.BufferAttribute(unpack(mesh.triangles, Uint32Array), 1));
    geometry.computeVertexNormals();
    return geometry;
  }

  function edgesOf(mesh, geometry) {
    const edges = new THREE.BufferGeometry();
    edges.setAttribute('position', geometry.getAttribute('position'));
    edges.setIndex(new THREE.BufferAttribute(unpack(mesh.edges, Uint32Array), 1));
    return new THREE.LineSegments(edges, new THREE.LineBasicMaterial({ color: 0x30363d, transparent: true, opacity: 0.8 }));
  }

  /** A mesh, or a cloud of points where it has no triangles. */
  function shapeOf(mesh, geometry, material) {
    if (mesh.triangles) return new THREE.Mesh(geometry, material);
    geometry.setIndex(null);
    return new THREE.Points(geometry, new THREE.PointsMaterial({
      size: 3 * (window.devicePixelRatio || 1), sizeAttenuation: false, color: material.color,
      vertexColors: material.vertexColors, transparent: material.transparent, opacity: material.opacity
    }));
  }

  /** The number of the face that a triangle of a mesh belongs to. */
  function faceAt(mesh, triangle) {
    const faces = unpack(mesh.faces, Uint32Array);
    let number = 0;
    for (let i = 0; i < faces.length && faces[i + 1] <= triangle; i += 2) number = faces[i];
    return number;
  }

  const world = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(30, 1, size / 1000, size * 100);
  camera.up.set(0, 0, 1);
  world.add(camera);
  world.add(new THREE.HemisphereLight(0xffffff, 0xb8bcc4, 0.75));
  const lamp = new THREE.DirectionalLight(0xffffff, 0.35);
  lamp.position.set(-0.4, 0.5, 1);
  camera.add(lamp);
  const controls = new THREE.OrbitControls(camera, canvas);
  controls.screenSpacePanning = true;

  function render() {
    renderer.render(world, camera);
  }

  /** Shows a box from the direction that all pictures share. */
  function look(box) {
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    const narrow = Math.min(1, camera.aspect);
    const distance = 1.05 * sphere.radius / Math.sin(camera.fov * Math.PI / 360) / narrow;
    controls.target.copy(sphere.center);
    camera.position.set(1, -1.2, 0.8).normalize().multiplyScalar(distance).add(sphere.center);
    controls.update();
    render();
  }

  function resize() {
    const width = frame.clientWidth, height = frame.clientHeight;
    if (!width || !height) return;
    renderer.setPixelRatio(window.devicePixelRatio || 1);
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    render();
  }

  const ray = new THREE.Raycaster();
  ray.params.Points.threshold = size / 150;
  function aim(event) {
    const border = canvas.getBoundingClientRect();
    const x = event.clientX - border.left, y = event.clientY - border.top;
    ray.setFromCamera(new THREE.Vector2(2 * x / border.width - 1, 1 - 2 * y / border.height), camera);
    return { x: x, y: y, width: border.width };
  }

  /** Names what is under the pointer: one of marks() or else the nearest of the visible surfaces. */
  function describe(marks, surfaces, nameOf) {
    canvas.addEventListener('mousemove', event => {
      const at = aim(event);
      const seen = event.buttons ? [] : ray.intersectObjects(surfaces.filter(mesh => mesh.visible));
      const hit = ray.intersectObjects(marks()).concat(seen)[0];
      label.hidden = !hit;
      if (!hit) return;
      label.textContent = nameOf(hit);
      label.style.left = Math.min(at.x + 14, at.width - 230) + 'px';
      label.style.top = (at.y + 14) + 'px';
    });
    canvas.addEventListener('mouseleave', () => { label.hidden = true; });
  }

  controls.addEventListener('change', render);
  window.addEventListener('resize', resize);
  return { world, canvas, camera, unpack, geometryOf, edgesOf, shapeOf, faceAt, render, look, resize, describe, aim, ray };
}
