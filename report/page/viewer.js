// SPDX-License-Identifier: LGPL-2.1-or-later
// Both models in space. Without WebGL the page keeps its still pictures.
(function () {
  'use strict';

  const scene = JSON.parse(document.getElementById('scene').textContent);
  const figure = document.querySelector('.viewer');
  const stage = makeStage(figure, scene.diagonal || 1);
  if (!stage) return;
  const { world, canvas, camera, unpack, geometryOf, edgesOf, shapeOf, render } = stage;
  const size = scene.diagonal || 1;

  function colorsOf(deviation, table, low, high) {
    const parsed = table.map(text => new THREE.Color(text));
    const colors = new Float32Array(3 * deviation.length);
    deviation.forEach((value, i) => {
      const t = Math.min(1, Math.max(0, (value - low) / (high - low)));
      parsed[Math.round(t * (parsed.length - 1))].toArray(colors, 3 * i);
    });
    return new THREE.BufferAttribute(colors, 3);
  }

  // The suspect, coloured by deviation.
  const suspectGeometry = geometryOf(scene.suspect);
  const deviation = unpack(scene.suspect.deviation, Float32Array);
  const coloring = {};
  if (scene.posed) {
    const magnitude = deviation.map(Math.abs);
    coloring.size = colorsOf(magnitude, scene.colors.size, 0, scene.range);
    coloring.signed = colorsOf(deviation, scene.colors.signed, -scene.range, scene.range);
    suspectGeometry.setAttribute('color', coloring.size);
  }
  const suspect = shapeOf(scene.suspect, suspectGeometry, new THREE.MeshPhongMaterial({
    specular: 0x4a4a4a, shininess: 18,
    color: scene.posed ? 0xffffff : 0xc8a98a,
    vertexColors: scene.posed ? THREE.VertexColors : THREE.NoColors,
    side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1
  }));
  const suspectEdges = edgesOf(scene.suspect, suspectGeometry);

  // The original, translucent where both lie on each other.
  const originalGeometry = geometryOf(scene.original);
  const original = shapeOf(scene.original, originalGeometry, new THREE.MeshLambertMaterial({
    color: 0x9db4c8, side: THREE.DoubleSide, transparent: scene.posed, opacity: scene.posed ? 0.35 : 1,
    depthWrite: !scene.posed, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2
  }));
  const originalEdges = edgesOf(scene.original, originalGeometry);
  world.add(suspect, suspectEdges, original, originalEdges);

  // Umbilics: a shape for each type, a short line along each line of curvature that runs into it.
  const shapes = {
    'star': new THREE.TetrahedronBufferGeometry(1.5),
    'lemon': new THREE.SphereBufferGeometry(1, 12, 8),
    'monstar': new THREE.BoxBufferGeometry(1.6, 1.6, 1.6),
    'non-generic': new THREE.OctahedronBufferGeometry(1.3)
  };
  const umbilics = new THREE.Group();
  const glyphs = [];
  scene.umbilics.forEach(umbilic => {
    const color = scene.types[umbilic.type];
    const glyph = new THREE.Mesh(shapes[umbilic.type],
      new THREE.MeshBasicMaterial({ color: color, wireframe: umbilic.suspect }));
    glyph.position.fromArray(umbilic.point);
    glyph.scale.setScalar(size * (umbilic.suspect ? 0.011 : 0.008));
    glyph.userData.text = umbilic.label;
    glyphs.push(glyph);
    umbilics.add(glyph);
    const ends = [];
    umbilic.directions.forEach(direction => {
      const reach = new THREE.Vector3().fromArray(direction).multiplyScalar(0.035 * size);
      ends.push(glyph.position.clone().add(reach), glyph.position.clone().sub(reach));
    });
    umbilics.add(new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(ends),
      new THREE.LineBasicMaterial({ color: color })));
  });
  world.add(umbilics);

  // The original's wireframe: lines by kind, dots for nodes; paler on the dark end of the scale.
  const wires = new THREE.Group();
  const points = text => new THREE.BufferGeometry()
    .setAttribute('position', new THREE.BufferAttribute(unpack(text, Float32Array), 3));
  scene.wires.kinds.forEach(kind => {
    const color = new THREE.Color(kind.color).lerp(new THREE.Color(0xffffff), scene.posed ? 0.4 : 0);
    wires.add(new THREE.LineSegments(points(kind.ends), new THREE.LineBasicMaterial({ color: color })));
  });
  wires.add(new THREE.Points(points(scene.wires.nodes), new THREE.PointsMaterial({
    size: 4 * (window.devicePixelRatio || 1), sizeAttenuation: false, color: scene.posed ? 0xffffff : 0x1c2128 })));
  world.add(wires);

  function reset() {
    const box = new THREE.Box3().setFromObject(suspect);
    if (!scene.posed) box.union(new THREE.Box3().setFromObject(original));
    stage.look(box);
  }

  function box(name) {
    const input = figure.querySelector('input[name=' + name + ']');
    return input ? input.checked : false;
  }

  function toggle() {
    suspect.visible = box('suspect');
    original.visible = box('original');
    umbilics.visible = box('umbilics');
    wires.visible = box('wires');
    suspectEdges.visible = suspect.visible && box('edges');
    originalEdges.visible = original.visible && box('edges');
    if (scene.posed) {
      const signed = box('signed');
      suspectGeometry.setAttribute('color', signed ? coloring.signed : coloring.size);
      figure.querySelector('.legends').classList.toggle('signed', signed);
    }
    render();
  }

  function nameOf(hit) {
    if (hit.object.userData.text) return hit.object.userData.text;
    const placeOn = mesh => mesh.faces ? ', face ' + stage.faceAt(mesh, hit.faceIndex) : '';
    if (hit.object === original) return 'Original' + placeOn(scene.original);
    const text = 'Suspect' + placeOn(scene.suspect);
    if (!scene.posed) return text;
    const corners = hit.face ? [hit.face.a, hit.face.b, hit.face.c] : [hit.index];
    const nearest = corners.reduce((best, i) => {
      const p = new THREE.Vector3().fromBufferAttribute(suspectGeometry.getAttribute('position'), i);
      const distance = p.distanceTo(hit.point);
      return distance < best.distance ? { i: i, distance: distance } : best;
    }, { i: corners[0], distance: Infinity });
    return text + ', deviation ' + deviation[nearest.i].toPrecision(3) + ' mm';
  }

  stage.describe(() => umbilics.visible ? glyphs : [], [suspect, original], nameOf);
  figure.querySelectorAll('input').forEach(input => input.addEventListener('change', toggle));
  figure.querySelector('button[name=reset]').addEventListener('click', reset);

  stage.resize();
  toggle();
  reset();
})();
