// The page that compare.mjs drives: a scene in three.js with the godrays of three-good-godrays. Frames go to half float buffers
// and not to the screen, so that a frame with the effect takes longer than one without by the effect's own passes.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { EffectComposer, RenderPass } from 'postprocessing';
import { GodraysPass } from 'three-good-godrays';

const width = 640, height = 360;
let renderer, scene, camera, light, medium, dither, converged, composer;

// The sun's shadow map covers the whole scene, because the library marches a ray only where its shadow map is.
function fitSun() {
    const box = new THREE.Box3().setFromObject(scene), eye = light.shadow.camera;
    const direction = light.target.getWorldPosition(new THREE.Vector3()).sub(light.position).normalize();
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    light.position.copy(sphere.center).addScaledVector(direction, -sphere.radius);
    light.updateMatrixWorld(true);
    light.shadow.updateMatrices(light);
    box.applyMatrix4(eye.matrixWorldInverse);
    Object.assign(eye, { left: box.min.x, right: box.max.x, bottom: box.min.y, top: box.max.y, near: -box.max.z, far: -box.min.z });
    eye.updateProjectionMatrix();
}

function compose(settings) {
    composer?.dispose();
    composer = new EffectComposer(renderer, { frameBufferType: THREE.HalfFloatType });
    composer.autoRenderToScreen = false;
    composer.setSize(width, height, false);
    composer.addPass(new RenderPass(scene, camera));
    if (settings) composer.addPass(new GodraysPass(light, camera, { ...medium, gammaCorrection: false, ...settings }));
}

function read(columns, rows) {
    const half = new Uint16Array(columns * rows * 4);
    const drawn = composer.passes.length > 1 ? composer.outputBuffer : composer.inputBuffer;  // the first pass draws in place
    renderer.readRenderTargetPixels(drawn, 0, 0, columns, rows, half);
    return Float64Array.from({ length: columns * rows }, (_, i) => THREE.DataUtils.fromHalfFloat(half[4 * i]));
}

function picture(settings) {  // with dark surfaces, the second frame, as the shadow map reaches the effect in the first
    compose(settings);
    light.intensity = 0;
    composer.render();
    composer.render();
    light.intensity = 1;
    return read(width, height);
}

// The library adds 1 - exp(-light) and a dither for the screen; here is the light.
const added = settings => picture(settings).map((value, i) => -Math.log(1 - value + dither[i]));

window.load = async (gltf, mediumSettings, shadowSize, lampReach) => {
    medium = mediumSettings;
    renderer = new THREE.WebGLRenderer();
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    ({ scene, cameras: [camera] } = await new GLTFLoader().parseAsync(gltf, ''));
    scene.updateMatrixWorld(true);
    scene.traverse(node => {
        if (node.isLight) light = node;
        if (node.isMesh) Object.assign(node, { castShadow: node.userData.cast_shadow !== false, receiveShadow: true });
    });
    light.castShadow = true;
    light.intensity = 1;
    light.shadow.mapSize.setScalar(shadowSize);
    if (light.isPointLight) Object.assign(light.shadow.camera, { near: 0.1, far: lampReach });
    else fitSun();
    dither = picture({ density: 0 });
    converged = added({ raymarchSteps: 2048, resolutionScale: 1, blur: false, upsampleQuality: 0 });
    const gl = renderer.getContext();
    return gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL);
};

// Relative RMSE against the converged picture, over its mean.
window.error = settings => {
    const squares = added(settings).reduce((sum, value, i) => sum + (value - converged[i]) ** 2, 0);
    return Math.sqrt(squares * converged.length) / converged.reduce((sum, value) => sum + value, 0);
};

// Draws frames, each of which has ended when the next begins. With settings it begins anew, null is without the effect.
window.draw = (frames, settings) => {
    if (settings !== undefined) compose(settings);
    for (let i = 0; i < frames; i++) {
        composer.render();
        read(1, 1);
    }
};
